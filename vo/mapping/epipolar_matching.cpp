// SPDX-License-Identifier: MIT
#include "vo/mapping/epipolar_matching.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "vo/geometry/essential_matrix.h"
#include "vo/mapping/ray_grid.h"

namespace corvo {
namespace {

constexpr double kCellPx = 24;  // Side of a grid cell; affects only the speed.

/// Matches the keypoints of one frame with those of another with a known relative pose.
class EpipolarMatcher {
 public:
  EpipolarMatcher(const Frame& first, const Frame& second, const MeasurementModel& model,
                  const EpipolarMatchingOptions& options)
      : options_(options),
        second_from_first_(second.world_from_camera.Inverse() * first.world_from_camera),
        essential_(EssentialMatrix(second_from_first_)),
        first_(CollectUnmatched(first, model)),
        grid_(CollectUnmatched(second, model), kCellPx / model.camera.focal()),
        second_(grid_.points()),
        octave_step_(model.octave_scales.size() > 1 ? model.octave_scales[1] : 1),
        buffer_(second_.index.size() + 1) {}

  std::vector<orb::Match> MatchAll() {
    std::vector<orb::Match> matches;
    for (int i = 0; i < first_.size(); ++i) {
      const orb::Nearest nearest = FindNearest(i);
      if (nearest.index < 0 || nearest.distance > options_.max_distance) continue;
      if (nearest.distance > options_.max_ratio * nearest.second_distance) continue;
      matches.push_back({first_.index[i], second_.index[nearest.index], nearest.distance});
    }
    return matches;
  }

 private:
  /// A keypoint of the first frame, expressed in the second camera.
  struct Query {
    Eigen::Vector3d direction;  // Direction of the keypoint's ray, for depth 1 in the first camera.
    Eigen::Vector3d origin;     // Center of the first camera.
    int axis = 0;               // Image axis along which the epipolar segment is longer.
    double octave_scale = 1;
  };

  orb::Nearest FindNearest(int i) {
    const Eigen::Vector3d ray(first_.x[i], first_.y[i], 1);
    Query query{second_from_first_.rotation() * ray, second_from_first_.translation(), 0,
                first_.octave_scales[i]};
    std::optional<EpipolarSegment> segment = ProjectRay(query);
    if (!segment) return {};
    segment->line = essential_ * ray;
    const Eigen::Vector2d along = (segment->far - segment->near).cwiseAbs();
    query.axis = along.x() > along.y() ? 0 : 1;
    const std::span<int> near = grid_.Find(*segment, buffer_);
    const auto last = std::remove_if(
        near.begin(), near.end(), [&](int candidate) { return !MayBeOnePoint(query, candidate); });
    return orb::FindNearestAmong(first_.descriptors[i], second_.descriptors, {near.begin(), last});
  }

  /// Returns the image of a ray from the least depth to infinity, or std::nullopt if the ray does
  /// not end in front of the second camera.
  std::optional<EpipolarSegment> ProjectRay(const Query& query) const {
    constexpr double kMinZ = 1e-3;  // Least z in the second camera, per unit of depth in the first.
    if (query.direction.z() < kMinZ) return std::nullopt;
    const double in_front = (kMinZ * options_.min_depth - query.origin.z()) / query.direction.z();
    const Eigen::Vector3d nearest =
        std::max(options_.min_depth, in_front) * query.direction + query.origin;
    if (!(nearest.z() > 0)) return std::nullopt;
    return EpipolarSegment{nearest.hnormalized(), query.direction.hnormalized(),
                           Eigen::Vector3d::Zero()};
  }

  /// Returns whether a query and a keypoint may observe the same point: their rays meet in front of
  /// both cameras, and the octave is coarser in the nearer camera. Nearly parallel rays meet
  /// anywhere.
  bool MayBeOnePoint(const Query& query, int candidate) const {
    const double place = (query.axis == 0 ? second_.x : second_.y)[candidate];
    const double slope = place * query.direction.z() - query.direction[query.axis];
    const double max_parallel = options_.parallel_sigmas * options_.parallel_sigmas;
    double depth_ratio = 1;  // Depth in the first camera over that in the second.
    if (slope * slope > max_parallel * second_.variances[candidate]) {
      const double depth = (query.origin[query.axis] - place * query.origin.z()) / slope;
      const double second_depth = depth * query.direction.z() + query.origin.z();
      if (depth <= 0 || second_depth <= 0) return false;
      depth_ratio = depth / second_depth;
    }
    const double octave_ratio = second_.octave_scales[candidate] / query.octave_scale;
    const double tolerance = options_.octave_tolerance * octave_step_;
    return depth_ratio < octave_ratio * tolerance && octave_ratio < depth_ratio * tolerance;
  }

  const EpipolarMatchingOptions& options_;
  SE3 second_from_first_;
  Eigen::Matrix3d essential_;
  UnmatchedKeypoints first_;
  RayGrid grid_;
  const UnmatchedKeypoints& second_;
  double octave_step_;
  std::vector<int> buffer_;
};

}  // namespace

std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const MeasurementModel& model,
                                                const EpipolarMatchingOptions& options) {
  const std::vector<orb::Match> matches = EpipolarMatcher(first, second, model, options).MatchAll();
  return orb::KeepConsistentRotation(orb::KeepUnique(matches), first.features.keypoints,
                                     second.features.keypoints);
}

}  // namespace corvo
