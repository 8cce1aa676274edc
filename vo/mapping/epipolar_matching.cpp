#include "vo/mapping/epipolar_matching.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "vo/geometry/essential_matrix.h"
#include "vo/math/chi_square.h"

namespace corvo {
namespace {

/// The keypoints of a frame that see no landmark, with what the inner loops read.
struct FreeKeypoints {
  std::vector<int> index;
  std::vector<orb::Descriptor> descriptors;
  std::vector<double> x;  ///< Of the rays.
  std::vector<double> y;
  std::vector<double> max_squared_distances;  ///< From an epipolar line, squared ray units.
  std::vector<double> octave_scales;
};

template <typename T>
void Reorder(const std::vector<int>& order, std::vector<T>& values) {
  std::vector<T> reordered(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) reordered[i] = values[order[i]];
  values = std::move(reordered);
}

FreeKeypoints CollectFree(const Frame& frame, const Camera& camera, const KeypointNoise& noise) {
  FreeKeypoints free;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) continue;
    const double sigma = noise.Sigma(frame, k) / camera.FocalAt(frame.rays[k]);
    free.index.push_back(k);
    free.descriptors.push_back(frame.descriptor(k));
    free.x.push_back(frame.rays[k].x());
    free.y.push_back(frame.rays[k].y());
    free.max_squared_distances.push_back(kChiSquare1Dof95 * sigma * sigma);
    free.octave_scales.push_back(noise.octave_scales[frame.keypoint(k).octave]);
  }
  return free;
}

/// Where a keypoint may lie: between the images of its ray's nearest and farthest point.
struct Segment {
  Eigen::Vector2d near;
  Eigen::Vector2d far;
};

/// The image of a ray from `min_depth` to infinity. None where it does not end before the camera.
std::optional<Segment> ProjectRay(const Eigen::Vector2d& ray, const SE3& second_from_first,
                                  double min_depth) {
  constexpr double kMinZ = 1e-3;  // Of a ray of length 1.
  const Eigen::Vector3d direction = second_from_first.rotation() * ray.homogeneous();
  const Eigen::Vector3d& origin = second_from_first.translation();
  if (direction.z() < kMinZ) return std::nullopt;
  const double in_front = (kMinZ * min_depth - origin.z()) / direction.z();
  const Eigen::Vector3d nearest = std::max(min_depth, in_front) * direction + origin;
  if (!(nearest.z() > 0)) return std::nullopt;
  return Segment{nearest.hnormalized(), direction.hnormalized()};
}

/// A keypoint of the first frame as the second camera has it.
struct Query {
  Eigen::Vector3d direction;  ///< Of its ray: where it is at depth 1 before the first camera ...
  Eigen::Vector3d origin;     ///< ... less where the first camera is.
  int axis;                   ///< Of the picture, along which its image runs.
  double octave_scale;
};

/// Whether a query and a ray may show one point: where they meet lies in front of both cameras, and
/// the nearer camera sees it in the coarser octave. Rays within three sigmas of parallel meet
/// anywhere.
bool MayMeet(const Query& query, const FreeKeypoints& candidates, int candidate,
             double octave_step) {
  constexpr double kTolerance = 1.5;
  constexpr double kParallelSigmas = 3;
  const double place = (query.axis == 0 ? candidates.x : candidates.y)[candidate];
  const double slope = place * query.direction.z() - query.direction[query.axis];
  const double squared_sigma = candidates.max_squared_distances[candidate] / kChiSquare1Dof95;
  double nearness = 1;  // Depth before the first camera over that before the second.
  if (slope * slope > kParallelSigmas * kParallelSigmas * squared_sigma) {
    const double depth = (query.origin[query.axis] - place * query.origin.z()) / slope;
    const double second_depth = depth * query.direction.z() + query.origin.z();
    if (depth <= 0 || second_depth <= 0) return false;
    nearness = depth / second_depth;
  }
  const double by_octave = candidates.octave_scales[candidate] / query.octave_scale;
  const double tolerance = kTolerance * octave_step;
  return nearness < by_octave * tolerance && by_octave < nearness * tolerance;
}

/// Finds the rays near a segment, by cells of a grid over all.
class RayGrid {
 public:
  RayGrid(FreeKeypoints points, double cell_size)
      : points_(std::move(points)), size_(cell_size), cells_per_unit_(1 / cell_size) {
    if (points_.x.empty()) return;
    const auto [left, right] = std::minmax_element(points_.x.begin(), points_.x.end());
    const auto [top, bottom] = std::minmax_element(points_.y.begin(), points_.y.end());
    origin_ = {*left, *top};
    columns_ = static_cast<int>((*right - *left) / size_) + 1;
    rows_ = static_cast<int>((*bottom - *top) / size_) + 1;
    SortIntoCells();
  }

  /// Cell by cell.
  const FreeKeypoints& points() const { return points_; }

  /// Indices of the points near the line through the segment, in the cells within `margin` of it.
  /// They stand in `buffer`, with room for all points.
  std::span<int> Find(const Segment& segment, const Eigen::Vector3d& line, double margin,
                      std::vector<int>& buffer) const {
    if (columns_ == 0) return {};
    const double norm = line.head<2>().squaredNorm();
    const double top = std::min(segment.near.y(), segment.far.y());
    const double bottom = std::max(segment.near.y(), segment.far.y());
    const Eigen::Vector2d along = segment.far - segment.near;
    const bool is_level = std::abs(along.y()) < 1e-12;
    const double slope = is_level ? 0 : along.x() / along.y();
    const int last_row = CellOf(bottom + margin - origin_.y(), rows_);
    const auto x_at = [&](double y) {
      return segment.near.x() + slope * (std::clamp(y, top, bottom) - segment.near.y());
    };
    int count = 0;
    for (int row = CellOf(top - margin - origin_.y(), rows_); row <= last_row; ++row) {
      const double row_top = origin_.y() + row * size_;
      const double x = x_at(row_top - margin);
      const double other_x = is_level ? segment.far.x() : x_at(row_top + size_ + margin);
      const int left = CellOf(std::min(x, other_x) - margin - origin_.x(), columns_);
      const int right = CellOf(std::max(x, other_x) + margin - origin_.x(), columns_);
      count = AppendNear(line, norm, starts_[row * columns_ + left],
                         starts_[row * columns_ + right + 1], buffer, count);
    }
    return std::span<int>(buffer).first(count);
  }

 private:
  int CellOf(double offset, int count) const {
    return static_cast<int>(std::clamp(offset * cells_per_unit_, 0.0, count - 1.0));
  }

  void SortIntoCells() {
    const int num_points = static_cast<int>(points_.x.size());
    const auto cell_of = [&](int i) {
      return CellOf(points_.y[i] - origin_.y(), rows_) * columns_ +
             CellOf(points_.x[i] - origin_.x(), columns_);
    };
    starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (int i = 0; i < num_points; ++i) ++starts_[cell_of(i) + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    std::vector<int> next = starts_;
    std::vector<int> order(num_points);
    for (int i = 0; i < num_points; ++i) order[next[cell_of(i)]++] = i;
    Reorder(order, points_.index);
    Reorder(order, points_.descriptors);
    Reorder(order, points_.x);
    Reorder(order, points_.y);
    Reorder(order, points_.max_squared_distances);
    Reorder(order, points_.octave_scales);
  }

  /// Writes those of the points from `begin` to `end` that are near a line behind the first `count`
  /// of a buffer, and returns the count with them. `norm` is the squared length of the line's
  /// normal.
  int AppendNear(const Eigen::Vector3d& line, double norm, int begin, int end,
                 std::vector<int>& buffer, int count) const {
    for (int i = begin; i < end; ++i) {
      const double distance = line.x() * points_.x[i] + line.y() * points_.y[i] + line.z();
      buffer[count] = i;  // Stays if the point is near, and is written over otherwise.
      count += distance * distance <= points_.max_squared_distances[i] * norm;
    }
    return count;
  }

  FreeKeypoints points_;
  double size_;
  double cells_per_unit_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> starts_;  // Cell c holds points starts_[c] to starts_[c + 1] - 1.
};

double LargestMargin(const FreeKeypoints& points) {
  double largest = 0;
  for (const double squared : points.max_squared_distances) largest = std::max(largest, squared);
  return std::sqrt(largest);
}

}  // namespace

std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const Camera& camera, const KeypointNoise& noise,
                                                double min_depth, int max_distance) {
  constexpr double kMaxRatio = 0.9;
  constexpr double kCellPx = 24;
  const SE3 second_from_first = second.world_from_camera.Inverse() * first.world_from_camera;
  const Eigen::Matrix3d essential = EssentialMatrix(second_from_first);
  const FreeKeypoints free_first = CollectFree(first, camera, noise);
  const double octave_step = noise.octave_scales.size() > 1 ? noise.octave_scales[1] : 1;
  const RayGrid grid(CollectFree(second, camera, noise), kCellPx / camera.focal());
  const FreeKeypoints& free_second = grid.points();
  const double margin = LargestMargin(free_second);
  std::vector<orb::Match> matches;
  std::vector<int> buffer(free_second.index.size() + 1);  // What is written over last, too.
  for (std::size_t i = 0; i < free_first.index.size(); ++i) {
    const Eigen::Vector2d ray(free_first.x[i], free_first.y[i]);
    const auto segment = ProjectRay(ray, second_from_first, min_depth);
    if (!segment) continue;
    const Eigen::Vector2d along = (segment->far - segment->near).cwiseAbs();
    const Query query{second_from_first.rotation() * ray.homogeneous(),
                      second_from_first.translation(), along.x() > along.y() ? 0 : 1,
                      free_first.octave_scales[i]};
    const std::span<int> near = grid.Find(*segment, essential * ray.homogeneous(), margin, buffer);
    const auto last = std::remove_if(near.begin(), near.end(), [&](int candidate) {
      return !MayMeet(query, free_second, candidate, octave_step);
    });
    const orb::Nearest nearest = orb::FindNearestAmong(
        free_first.descriptors[i], free_second.descriptors, {near.begin(), last});
    if (nearest.index < 0 || nearest.distance > max_distance) continue;
    if (nearest.distance > kMaxRatio * nearest.second_distance) continue;
    matches.push_back({free_first.index[i], free_second.index[nearest.index], nearest.distance});
  }
  return orb::KeepConsistentRotation(orb::KeepUnique(matches), first.features.keypoints,
                                     second.features.keypoints);
}

}  // namespace corvo
