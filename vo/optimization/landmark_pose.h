// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// A pose of a frame and the landmarks that its keypoints observe from there.
struct LandmarkPose {
  SE3 world_from_camera;
  std::vector<LandmarkId> landmarks;  ///< The inlier of each keypoint, or kNoId.
  int num_inliers = 0;
};

/// Returns the optimal pose of a frame whose keypoints observe `landmarks` (each has one or kNoId),
/// starting at `initial`, with its inliers.
LandmarkPose OptimizeLandmarkPose(const Map& map, const Frame& frame,
                                  std::vector<LandmarkId> landmarks, const SE3& initial,
                                  const PoseOptimizerOptions& options);

/// Returns a pose with those of `landmarks` whose reprojection error does not contradict it.
LandmarkPose SelectInliers(const Map& map, const Frame& frame, std::vector<LandmarkId> landmarks,
                           const SE3& world_from_camera);

}  // namespace corvo
