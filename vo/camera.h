#pragma once

#include <Eigen/Core>
#include <optional>

namespace corvo {

/// The numbers of a Camera. `Visit` names each once, with its range and meaning: validation and the
/// camera files come from it.
struct CameraParameters {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;

  /// Calls `field(name, value, min, max, meaning)` in order, as orb::ExtractorOptions::Visit.
  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("width", self.width, 1, 100000, "picture width, px");
    field("height", self.height, 1, 100000, "picture height, px");
    field("fx", self.fx, 1e-3, 1e6, "focal length along x, px");
    field("fy", self.fy, 1e-3, 1e6, "focal length along y, px");
    field("cx", self.cx, -1e6, 1e6, "principal point, px; integers are pixel centres");
    field("cy", self.cy, -1e6, 1e6, "principal point, px; integers are pixel centres");
    field("k1", self.k1, -1e3, 1e3, "radial distortion, factor of r^2");
    field("k2", self.k2, -1e3, 1e3, "radial distortion, factor of r^4");
    field("p1", self.p1, -1e3, 1e3, "tangential distortion, as OpenCV's");
    field("p2", self.p2, -1e3, 1e3, "tangential distortion, as OpenCV's");
    field("k3", self.k3, -1e3, 1e3, "radial distortion, factor of r^6");
  }

  bool operator==(const CameraParameters&) const = default;
};

/// Pinhole camera with radial-tangential distortion (Brown-Conrady, OpenCV's convention), x right,
/// y down, z forward; integer pixel coordinates are pixel centres. With a = x/z, b = y/z,
/// r² = a² + b², c = 1 + k1 r² + k2 r⁴ + k3 r⁶:
///
///     u = fx (a c + 2 p1 a b + p2 (r² + 2 a²)) + cx
///     v = fy (b c + p1 (r² + 2 b²) + 2 p2 a b) + cy
///
/// A cheap value: new intrinsics are a new Camera.
class Camera {
 public:
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  /// Throws corvo::Error naming the first parameter out of range.
  explicit Camera(const CameraParameters& parameters);

  /// Pixel of a point. None where z <= 0 or outside max_radius(). The pixel may lie outside the
  /// picture. `jacobian`, if given, is d pixel / d point.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_camera,
                                         Jacobian* jacobian = nullptr) const;

  /// (x/z, y/z) of the ray through a pixel, to rounding; none where no ray inside max_radius()
  /// meets the pixel.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;

  /// The pixel lies in the picture: in [-0.5, width - 0.5) x [-0.5, height - 0.5).
  bool Contains(const Eigen::Vector2d& pixel) const;

  const CameraParameters& parameters() const { return parameters_; }
  int width() const { return parameters_.width; }    ///< px
  int height() const { return parameters_.height; }  ///< px
  double fx() const { return parameters_.fx; }       ///< px
  double fy() const { return parameters_.fy; }       ///< px
  double cx() const { return parameters_.cx; }       ///< px
  double cy() const { return parameters_.cy; }       ///< px
  /// Mean focal length, px: turns small angles into pixels.
  double focal() const { return 0.5 * (fx() + fy()); }

  /// The model holds for r below this: up to here r c(r) grows with r, beyond it rays would meet
  /// the picture twice. Infinity if it always grows.
  double max_radius() const { return max_radius_; }

  bool operator==(const Camera&) const = default;

 private:
  CameraParameters parameters_;
  double max_radius_;
};

}  // namespace corvo
