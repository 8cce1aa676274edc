// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/map/map.h"
#include "vo/map/segment_join.h"
#include "vo/tracking/relocalizer.h"

namespace corvo {

/// A keyframe that was also located in another segment than its own.
struct TwiceLocated {
  KeyframeId keyframe = kNoId;
  int segment = kNoId;    ///< The other segment.
  SE3 world_from_camera;  ///< The pose in the other segment.
  std::vector<LandmarkId>
      landmarks;  ///< Of the other segment, observed by each keypoint; or kNoId.
};

/// The similarity between two segments as one keyframe gives it.
struct JoinEstimate {
  SegmentJoin join;
  Eigen::Vector3d camera_in_later;  ///< Position of the keyframe in the later segment.
  double depth = 0;                 ///< Median depth of the common landmarks, earlier segment.
};

/// Estimates the similarity between the segments in which a keyframe was located. Rotation and
/// position follow from the two poses, the scale from the median ratio of the two depths of the
/// keypoints that observe a landmark in both segments. Returns std::nullopt if these are too few,
/// or if too few of them agree on the scale.
std::optional<JoinEstimate> EstimateJoin(const Map& map, const TwiceLocated& located,
                                         const SegmentJoiningOptions& options);

/// Returns whether two estimates agree on the segments, the scale and the pose.
bool AreConsistent(const JoinEstimate& first, const JoinEstimate& second,
                   const SegmentJoiningOptions& options);

/// After the segments were joined: merges the landmarks that the same keypoints observe into the
/// older ones, and makes keypoints that observe none observe that of the other segment. Landmarks
/// whose depths differ by more than `max_depth_factor` are left alone. Returns the merges.
std::vector<LandmarkMerge> MergeCommonLandmarks(const TwiceLocated& located,
                                                double max_depth_factor, Map& map);

/// Finds out when the camera sees the landmarks of another segment, and how the two are related.
class SegmentJoiner {
 public:
  explicit SegmentJoiner(const OdometryOptions& options);

  /// Searches for the newest keyframe in the segments other than its own. Returns whether it and
  /// the newest keyframe before it were located in the same segment and give consistent
  /// similarities, and the later of the two segments is movable.
  bool Search(Map& map);

  /// After Search() returned true and adjustments in progress were applied: returns the similarity
  /// by the newest keyframe in the current map, or std::nullopt if it is no longer consistent.
  std::optional<SegmentJoin> Estimate(const Map& map) const;

  /// After the segments were joined: see MergeCommonLandmarks().
  std::vector<LandmarkMerge> MergeLandmarks(Map& map);

 private:
  SegmentJoiningOptions options_;
  Relocalizer relocalizer_;
  std::optional<JoinEstimate> before_;  // By the keyframe before the newest.
  std::optional<JoinEstimate> newest_;
  TwiceLocated located_;  // The newest keyframe.
};

}  // namespace corvo
