// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/map/map.h"
#include "vo/map/pose_graph.h"
#include "vo/mapping/pose_uncertainty.h"

namespace corvo {

/// Collects the edges of the pose graph while the map grows: those of each new keyframe, which are
/// renewed as long as its window is adjusted.
class KeyframeEdges {
 public:
  /// Adds edges from the newest keyframe of the map to the one before it and to those that share
  /// most landmarks with it.
  void AddKeyframe(const Map& map, const PoseUncertainty& uncertainty,
                   const CameraEstimate& camera);
  /// Renews the edges between keyframes of the joint covariance.
  void Renew(const Map& map, const PoseUncertainty& uncertainty, const CameraEstimate& camera);
  /// Expresses the edges of the later segment in the unit of the earlier one.
  void JoinSegments(const SegmentJoin& join);

  /// Returns the graph with the poses of the map.
  PoseGraph ToGraph(const Map& map) const;

  std::size_t num_bytes() const { return edges_.size() * sizeof(Edges::value_type); }

 private:
  struct Edge {
    int segment = 0;
    SE3::Matrix6 covariance = SE3::Matrix6::Zero();
    double log_scale_variance = 0;
  };
  using Edges = std::map<std::pair<KeyframeId, KeyframeId>, Edge>;  // By the later, the earlier.

  Edges edges_;
  std::map<KeyframeId, int> frames_;
};

/// Returns the variance of the logarithm of the scale that the common landmarks of two keyframes
/// transfer from one to the other, in units of the variance of image measurements: that of the
/// weighted mean of the landmarks' relative distances. It is at most 1.
double LogScaleVariance(const Map& map, KeyframeId first, KeyframeId second);

}  // namespace corvo
