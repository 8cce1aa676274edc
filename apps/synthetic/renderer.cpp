// SPDX-License-Identifier: MIT
#include "apps/synthetic/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace corvo::synthetic {
namespace {

constexpr int kTile = 16;  ///< Side of the square of pixels that shares a list of surfaces, px.
constexpr int kSubsamples = 16;  ///< Rays through a pixel at the edge of a surface.

using Ray = Eigen::Vector2d;  ///< (x/z, y/z)

double Along(const Eigen::Vector3d& form, const Ray& ray) {
  return form.x() * ray.x() + form.y() * ray.y() + form.z();
}

/// A quad in the frame of one camera, as linear forms of h = (x/z, y/z, 1):
///
///     1/z = inverse_depth . h,  u = (u . h) z,  v = (v . h) z
struct View {
  Eigen::Vector3d inverse_depth, u, v;
  double nearest;  ///< Largest 1/z of the quad; infinity if it extends behind the camera.
  const Quad* quad;
  const Texture* texture;

  /// Returns 1/z of the point where the ray meets the quad, or 0 if it does not.
  double Meet(const Ray& ray) const {
    const double w = Along(inverse_depth, ray);
    const double a = Along(u, ray), b = Along(v, ray);
    const bool inside = w > 0 && a >= 0 && b >= 0 && a <= quad->width * w && b <= quad->height * w;
    return inside ? w : 0;
  }
};

/// Returns a tight upper bound of the largest 1/z of a rectangle, which is at one of its corners.
double LargestInverseDepth(const Eigen::Vector3d& corner, const Eigen::Vector3d& width,
                           const Eigen::Vector3d& height) {
  const double least_z = corner.z() + std::min(width.z(), 0.0) + std::min(height.z(), 0.0);
  return least_z > 0 ? (1 + 1e-9) / least_z : std::numeric_limits<double>::infinity();
}

/// Returns std::nullopt if the camera is behind the quad.
std::optional<View> MakeView(const Scene& scene, const Quad& quad,
                             const Eigen::Matrix3d& camera_from_scene_rotation,
                             const Eigen::Vector3d& camera_in_scene) {
  const Eigen::Vector3d corner = camera_from_scene_rotation * (quad.corner - camera_in_scene);
  const Eigen::Vector3d right = camera_from_scene_rotation * quad.right;
  const Eigen::Vector3d down = camera_from_scene_rotation * quad.down;
  const Eigen::Vector3d normal = right.cross(down);
  const double distance = normal.dot(corner);
  if (distance < 1e-6) return std::nullopt;
  View view;
  view.inverse_depth = normal / distance;
  view.u = right - right.dot(corner) * view.inverse_depth;
  view.v = down - down.dot(corner) * view.inverse_depth;
  view.nearest = LargestInverseDepth(corner, quad.width * right, quad.height * down);
  view.quad = &quad;
  view.texture = &scene.textures[static_cast<std::size_t>(quad.texture)];
  return view;
}

/// The bounds of a set of rays.
struct RayBox {
  Ray low = Ray::Constant(std::numeric_limits<double>::infinity());
  Ray high = Ray::Constant(-std::numeric_limits<double>::infinity());

  void Include(const Ray& ray) {
    if (!ray.allFinite()) return;
    low = low.cwiseMin(ray);
    high = high.cwiseMax(ray);
  }

  double Largest(const Eigen::Vector3d& form) const {
    return form.x() * (form.x() > 0 ? high.x() : low.x()) +
           form.y() * (form.y() > 0 ? high.y() : low.y()) + form.z();
  }

  /// Returns false only if no ray of the box meets the quad.
  bool MayMeet(const View& view) const {
    return Largest(view.inverse_depth) > 0 && Largest(view.u) >= 0 && Largest(view.v) >= 0 &&
           Largest(view.quad->width * view.inverse_depth - view.u) >= 0 &&
           Largest(view.quad->height * view.inverse_depth - view.v) >= 0;
  }
};

struct Candidate {
  const View* view;
  double nearest;  ///< An upper bound of 1/z in the tile.
};

/// Returns the surface that the ray meets first, or null if there is none. The candidates are
/// ordered from near to far.
const View* FirstMet(const std::vector<Candidate>& candidates, const Ray& ray) {
  const View* first = nullptr;
  double nearest = 0;
  for (const Candidate& candidate : candidates) {
    if (candidate.nearest <= nearest) break;
    const double inverse_depth = candidate.view->Meet(ray);
    if (inverse_depth > nearest) {
      nearest = inverse_depth;
      first = candidate.view;
    }
  }
  return first;
}

/// The rays of one pixel, interpolated bilinearly between those of its corners.
struct PixelRays {
  Ray origin, across, along, twist;

  PixelRays(const Ray& upper_left, const Ray& upper_right, const Ray& lower_left,
            const Ray& lower_right)
      : origin(upper_left),
        across(upper_right - upper_left),
        along(lower_left - upper_left),
        twist(lower_right - upper_right - lower_left + upper_left) {}

  /// Returns the ray at (x, y), measured from the upper left corner, 0 <= x, y <= 1.
  Ray At(double x, double y) const { return origin + x * across + y * along + x * y * twist; }
};

/// Returns the position of the i-th subsample in a pixel: a Hammersley point set (1960), whose x
/// and y take kSubsamples different values each, so that an edge along either axis is resolved to
/// 1/16 pixel.
Eigen::Vector2d SubsamplePlace(int i) {
  const int reversed = (i & 1) << 3 | (i & 2) << 1 | (i & 4) >> 1 | (i & 8) >> 3;
  return Eigen::Vector2d(i + 0.5, reversed + 0.5) / kSubsamples;
}

/// Returns the gray of a surface around `ray`, filtered over one pixel.
double Shade(const View& view, const Ray& ray, const PixelRays& pixel) {
  const double z = 1 / Along(view.inverse_depth, ray);
  const double u = z * Along(view.u, ray), v = z * Along(view.v, ray);
  const Ray du = z * (view.u.head<2>() - u * view.inverse_depth.head<2>());
  const Ray dv = z * (view.v.head<2>() - v * view.inverse_depth.head<2>());
  const Eigen::Array2d scale = view.quad->texels_per_meter;
  const Eigen::Array2d across(du.dot(pixel.across), dv.dot(pixel.across));
  const Eigen::Array2d along(du.dot(pixel.along), dv.dot(pixel.along));
  const Eigen::Array2d position = view.quad->texture_origin.array() + scale * Eigen::Array2d(u, v);
  return view.quad->gain * view.texture->Sample(position, scale * across, scale * along);
}

/// The subsamples of one pixel that meet the same surface.
struct Share {
  const View* view;
  Ray sum;
  int count;
};

/// Returns the mean over a pixel that contains several surfaces. Each surface is shaded once, at
/// the mean of its rays.
double ShadeEdge(const std::vector<Candidate>& candidates, const PixelRays& pixel,
                 double background) {
  std::array<Share, kSubsamples> shares;
  std::size_t num_shares = 0;
  for (int i = 0; i < kSubsamples; ++i) {
    const Eigen::Vector2d place = SubsamplePlace(i);
    const Ray ray = pixel.At(place.x(), place.y());
    const View* view = FirstMet(candidates, ray);
    std::size_t k = 0;
    while (k < num_shares && shares[k].view != view) ++k;
    if (k == num_shares) shares[num_shares++] = {view, Ray::Zero(), 0};
    shares[k].sum += ray;
    ++shares[k].count;
  }
  double sum = 0;
  for (std::size_t k = 0; k < num_shares; ++k) {
    const Share& share = shares[k];
    sum += share.count *
           (share.view ? Shade(*share.view, share.sum / share.count, pixel) : background);
  }
  return sum / kSubsamples;
}

/// One image being rendered.
class Rendering {
 public:
  Rendering(const Scene& scene, const Camera& camera, const std::vector<Ray>& corner_rays,
            const SE3& scene_from_camera, const std::vector<Quad>& more)
      : scene_(scene), camera_(camera), corner_rays_(corner_rays) {
    const Eigen::Matrix4d matrix = scene_from_camera.matrix();
    const Eigen::Matrix3d camera_from_scene = matrix.topLeftCorner<3, 3>().transpose();
    const RayBox all = Bounds(0, 0, camera.width(), camera.height());
    for (const std::vector<Quad>* quads : {&scene.quads, &more}) {
      for (const Quad& quad : *quads) {
        const auto view = MakeView(scene, quad, camera_from_scene, matrix.topRightCorner<3, 1>());
        if (view && all.MayMeet(*view)) views_.push_back(*view);
      }
    }
  }

  /// Calls `shade(candidates, x, y, width, height)` for every tile.
  template <typename TileFunction>
  void ForEachTile(TileFunction&& shade) const {
    const int num_bands = (camera_.height() + kTile - 1) / kTile;
    tbb::parallel_for(0, num_bands, [&](int band) {
      const int y = band * kTile, height = std::min(kTile, camera_.height() - y);
      const auto in_band = Candidates(views_, Bounds(0, y, camera_.width(), height));
      for (int x = 0; x < camera_.width(); x += kTile) {
        const int width = std::min(kTile, camera_.width() - x);
        shade(Candidates(in_band, Bounds(x, y, width, height)), cv::Rect(x, y, width, height));
      }
    });
  }

  void ShadeTile(const std::vector<Candidate>& candidates, const cv::Rect& tile,
                 cv::Mat* image) const {
    std::array<const View*, (kTile + 1) * (kTile + 1)> seen;
    for (int i = 0; i < (tile.width + 1) * (tile.height + 1); ++i) {
      const int x = i % (tile.width + 1), y = i / (tile.width + 1);
      seen[static_cast<std::size_t>(i)] = FirstMet(candidates, CornerRay(tile.x + x, tile.y + y));
    }
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const View* const* upper = &seen[y * (tile.width + 1) + x];
        const View* const* lower = upper + tile.width + 1;
        const bool same = upper[0] == upper[1] && upper[0] == lower[0] && upper[0] == lower[1];
        image->at<std::uint8_t>(tile.y + y, tile.x + x) =
            Quantize(Gray(candidates, same, upper[0], RaysOf(tile.x + x, tile.y + y)));
      }
    }
  }

  void MeasureTile(const std::vector<Candidate>& candidates, const cv::Rect& tile,
                   cv::Mat* depth) const {
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const Ray ray = RaysOf(x, y).At(0.5, 0.5);
        const View* view = FirstMet(candidates, ray);
        depth->at<float>(y, x) =
            view ? static_cast<float>(1 / Along(view->inverse_depth, ray)) : 0.0f;
      }
    }
  }

 private:
  static std::uint8_t Quantize(double gray) {
    return static_cast<std::uint8_t>(std::clamp(gray, 0.0, 255.0) + 0.5);
  }

  double Gray(const std::vector<Candidate>& candidates, bool same, const View* view,
              const PixelRays& pixel) const {
    const Ray center = pixel.At(0.5, 0.5);
    if (!center.allFinite()) return 0;
    if (!same) return ShadeEdge(candidates, pixel, scene_.background);
    return view ? Shade(*view, center, pixel) : scene_.background;
  }

  const Ray& CornerRay(int x, int y) const {
    return corner_rays_[static_cast<std::size_t>(y) *
                            static_cast<std::size_t>(camera_.width() + 1) +
                        static_cast<std::size_t>(x)];
  }

  PixelRays RaysOf(int x, int y) const {
    return PixelRays(CornerRay(x, y), CornerRay(x + 1, y), CornerRay(x, y + 1),
                     CornerRay(x + 1, y + 1));
  }

  RayBox Bounds(int x, int y, int width, int height) const {
    RayBox box;
    for (int row = y; row <= y + height; ++row) {
      for (int column = x; column <= x + width; ++column) box.Include(CornerRay(column, row));
    }
    return box;
  }

  static const View& ViewOf(const View& view) { return view; }
  static const View& ViewOf(const Candidate& candidate) { return *candidate.view; }

  /// Returns the elements of `among` that rays of the box may meet, from near to far.
  template <typename Container>
  static std::vector<Candidate> Candidates(const Container& among, const RayBox& box) {
    std::vector<Candidate> candidates;
    for (const auto& element : among) {
      const View& view = ViewOf(element);
      if (!box.MayMeet(view)) continue;
      candidates.push_back({&view, std::min(view.nearest, box.Largest(view.inverse_depth))});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.nearest > b.nearest; });
    return candidates;
  }

  const Scene& scene_;
  const Camera& camera_;
  const std::vector<Ray>& corner_rays_;
  std::vector<View> views_;
};

}  // namespace

Renderer::Renderer(const Camera& camera) : camera_(camera) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int y = 0; y <= camera.height(); ++y) {
    for (int x = 0; x <= camera.width(); ++x) {
      corner_rays_.push_back(camera.Undistort({x - 0.5, y - 0.5}).value_or(Ray(nan, nan)));
    }
  }
}

cv::Mat Renderer::Render(const Scene& scene, const SE3& scene_from_camera,
                         const std::vector<Quad>& more) const {
  cv::Mat image(camera_.height(), camera_.width(), CV_8UC1);
  const Rendering rendering(scene, camera_, corner_rays_, scene_from_camera, more);
  rendering.ForEachTile([&](const std::vector<Candidate>& candidates, const cv::Rect& tile) {
    rendering.ShadeTile(candidates, tile, &image);
  });
  return image;
}

cv::Mat Renderer::RenderDepth(const Scene& scene, const SE3& scene_from_camera,
                              const std::vector<Quad>& more) const {
  cv::Mat depth(camera_.height(), camera_.width(), CV_32FC1);
  const Rendering rendering(scene, camera_, corner_rays_, scene_from_camera, more);
  rendering.ForEachTile([&](const std::vector<Candidate>& candidates, const cv::Rect& tile) {
    rendering.MeasureTile(candidates, tile, &depth);
  });
  return depth;
}

}  // namespace corvo::synthetic
