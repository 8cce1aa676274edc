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
#include "vo/optimization/keyframe_innovations.h"

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

  std::size_t num_bytes() const;

 private:
  struct Edge {
    int segment = 0;
    PoseGraphEdge::Matrix7 covariance = PoseGraphEdge::Matrix7::Zero();
    PoseGraphEdge::Matrix7X by_camera = PoseGraphEdge::Matrix7X(7, 0);
  };
  /// Returns the edge between two keyframes of the joint covariance, given their positions, where
  /// their scale is that of `before` as long as too few keyframes follow.
  static Edge Renewed(const Edge& before, const KeyframeInnovations& innovations, int first,
                      int second, double factor);
  using Edges = std::map<std::pair<KeyframeId, KeyframeId>, Edge>;  // By the later, the earlier.

  Edges edges_;
  std::map<KeyframeId, int> frames_;
};

/// Returns the variance of the logarithm of the scale that the common landmarks of two keyframes
/// transfer from one to the other, in units of the variance of image measurements: that of the
/// weighted mean of the landmarks' relative distances, with the keyframes taken as exact. It is at
/// most 1. An edge states it until the joint covariance has enough later keyframes, see
/// KeyframeInnovations.
double LogScaleVariance(const Map& map, KeyframeId first, KeyframeId second);

}  // namespace corvo
