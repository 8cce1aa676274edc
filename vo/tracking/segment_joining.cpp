// SPDX-License-Identifier: MIT
#include "vo/tracking/segment_joining.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "vo/map/landmark_alignment.h"
#include "vo/math/factor.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

bool HasOtherSegment(const Map& map, int segment) {
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  return std::any_of(active.begin(), active.end(),
                     [&](KeyframeId id) { return map.SegmentOf(id) != segment; });
}

/// The depths of the landmarks that one keypoint observes in both segments.
struct DepthPair {
  double own = 0;
  double other = 0;

  double ratio() const { return other / own; }
};

std::vector<DepthPair> CollectDepths(const Map& map, const TwiceLocated& located) {
  const SE3 camera_from_own = map.WorldFromKeyframe(located.keyframe).Inverse();
  const SE3 camera_from_other = located.world_from_camera.Inverse();
  const std::vector<LandmarkId>& landmarks = map.keyframe(located.keyframe).frame.landmarks;
  std::vector<DepthPair> depths;
  for (std::size_t k = 0; k < landmarks.size(); ++k) {
    const Landmark* own = map.FindLandmark(landmarks[k]);
    const Landmark* other = map.FindLandmark(map.Resolve(located.landmarks[k]));
    if (own == nullptr || other == nullptr) continue;
    const DepthPair pair{(camera_from_own * own->in_world).z(),
                         (camera_from_other * other->in_world).z()};
    if (pair.own > 0 && pair.other > 0) depths.push_back(pair);
  }
  return depths;
}

/// Returns the median ratio of depths, or std::nullopt if they do not agree on one.
std::optional<double> FindScale(const std::vector<DepthPair>& depths,
                                const SegmentJoiningOptions& options) {
  if (static_cast<int>(depths.size()) < options.min_common_landmarks) return std::nullopt;
  std::vector<double> ratios;
  for (const DepthPair& pair : depths) ratios.push_back(pair.ratio());
  const double median = Median(ratios);
  const auto num_consistent =
      static_cast<double>(std::count_if(ratios.begin(), ratios.end(), [&](double ratio) {
        return IsWithinFactor(ratio / median, options.max_depth_factor);
      }));
  if (num_consistent < options.min_consistent_share * static_cast<double>(ratios.size())) {
    return std::nullopt;
  }
  return median;
}

/// Merges a landmark into an older one; their keypoints are aligned with the patch of the latter.
void Merge(const LandmarkMerge& merge, Map& map) {
  map.MergeLandmark(merge.from, merge.into);
  const std::vector<TrackElement> track = map.FindLandmark(merge.into)->track;
  for (const TrackElement& element : track) AlignTrackElement(merge.into, element, map);
  map.UpdateAppearance(merge.into);
}

}  // namespace

std::optional<JoinEstimate> EstimateJoin(const Map& map, const TwiceLocated& located,
                                         const SegmentJoiningOptions& options) {
  const std::vector<DepthPair> depths = CollectDepths(map, located);
  const std::optional<double> scale = FindScale(depths, options);
  if (!scale) return std::nullopt;
  const SE3 world_from_own = map.WorldFromKeyframe(located.keyframe);
  const Sim3 other_from_own = Sim3(located.world_from_camera) *
                              Sim3(*scale, SO3(), Eigen::Vector3d::Zero()) *
                              Sim3(world_from_own.Inverse());
  const int own = map.SegmentOf(located.keyframe);
  std::vector<double> depths_in_earlier;
  for (const DepthPair& pair : depths) {
    depths_in_earlier.push_back(own < located.segment ? pair.own : pair.other);
  }
  const double depth = Median(std::move(depths_in_earlier));
  if (own < located.segment) {
    return JoinEstimate{{own, located.segment, other_from_own.Inverse()},
                        located.world_from_camera.translation(),
                        depth};
  }
  return JoinEstimate{{located.segment, own, other_from_own}, world_from_own.translation(), depth};
}

bool AreConsistent(const JoinEstimate& first, const JoinEstimate& second,
                   const SegmentJoiningOptions& options) {
  const SegmentJoin& a = first.join;
  const SegmentJoin& b = second.join;
  if (a.earlier != b.earlier || a.later != b.later) return false;
  const Sim3 change = a.earlier_from_later.Inverse() * b.earlier_from_later;
  const double angle_deg = change.rotation().Log().norm() * 180 / std::numbers::pi;
  const double distance = (a.earlier_from_later * second.camera_in_later -
                           b.earlier_from_later * second.camera_in_later)
                              .norm();
  return IsWithinFactor(change.scale(), options.max_scale_factor) &&
         angle_deg <= options.max_rotation_deg &&
         distance <= options.max_translation_share * second.depth;
}

std::vector<LandmarkMerge> MergeCommonLandmarks(const TwiceLocated& located,
                                                double max_depth_factor, Map& map) {
  const SE3 camera_from_world = map.WorldFromKeyframe(located.keyframe).Inverse();
  const auto depth = [&](LandmarkId id) {
    return (camera_from_world * map.FindLandmark(id)->in_world).z();
  };
  std::vector<LandmarkMerge> merges;
  for (int k = 0; k < static_cast<int>(located.landmarks.size()); ++k) {
    const LandmarkId other = map.Resolve(located.landmarks[k]);
    if (other == kNoId || map.FindLandmark(other)->IsObservedBy(located.keyframe)) continue;
    const LandmarkId own = map.keyframe(located.keyframe).frame.landmarks[k];
    if (own == kNoId) {
      map.AddTrackElement(other, {located.keyframe, k});
      AlignTrackElement(other, {located.keyframe, k}, map);
      map.UpdateAppearance(other);
    } else if (IsWithinFactor(depth(own) / depth(other), max_depth_factor)) {
      merges.push_back({std::max(own, other), std::min(own, other)});
      Merge(merges.back(), map);
    }
  }
  return merges;
}

SegmentJoiner::SegmentJoiner(const OdometryOptions& options)
    : options_(options.segment_joining), relocalizer_(options) {}

bool SegmentJoiner::Search(Map& map) {
  before_ = std::exchange(newest_, std::nullopt);
  const Keyframe& keyframe = map.keyframe(map.num_keyframes() - 1);
  if (!HasOtherSegment(map, keyframe.segment)) return false;
  Frame frame = keyframe.frame;
  if (!relocalizer_.RelocalizeElsewhere(keyframe.segment, map, frame).is_tracked()) return false;
  located_ = {keyframe.id, SegmentOf(map, frame), frame.world_from_camera,
              std::move(frame.landmarks)};
  newest_ = EstimateJoin(map, located_, options_);
  return Estimate(map).has_value() && map.IsMovable(newest_->join.later);
}

std::optional<SegmentJoin> SegmentJoiner::Estimate(const Map& map) const {
  if (!before_) return std::nullopt;
  const std::optional<JoinEstimate> estimate = EstimateJoin(map, located_, options_);
  if (!estimate || !AreConsistent(*before_, *estimate, options_)) return std::nullopt;
  return estimate->join;
}

std::vector<LandmarkMerge> SegmentJoiner::MergeLandmarks(Map& map) {
  before_ = newest_ = std::nullopt;
  return MergeCommonLandmarks(located_, options_.max_depth_factor, map);
}

}  // namespace corvo
