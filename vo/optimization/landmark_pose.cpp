// SPDX-License-Identifier: MIT
#include "vo/optimization/landmark_pose.h"

#include <utility>

#include "vo/map/landmark_covariance.h"
#include "vo/math/chi_square.h"
#include "vo/optimization/pose_optimizer.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {

LandmarkPose OptimizeLandmarkPose(const Map& map, const Frame& frame,
                                  std::vector<LandmarkId> landmarks, const SE3& initial,
                                  const PoseOptimizerOptions& options) {
  std::vector<int> keypoints;
  PoseObservations observations;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (landmarks[k] == kNoId) continue;
    const Landmark& landmark = *map.FindLandmark(landmarks[k]);
    keypoints.push_back(k);
    observations.Add({landmark.in_world, LandmarkCovariance(map, landmark)},
                     Observe(frame, k, map.model()));
  }
  const PoseEstimate estimate = OptimizePose(initial, observations, map.camera(), options);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (!estimate.is_inlier[i]) landmarks[keypoints[i]] = kNoId;
  }
  return {estimate.world_from_camera, std::move(landmarks), estimate.num_inliers};
}

LandmarkPose SelectInliers(const Map& map, const Frame& frame, std::vector<LandmarkId> landmarks,
                           const SE3& world_from_camera) {
  const SE3 camera_from_world = world_from_camera.Inverse();
  int num_inliers = 0;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (landmarks[k] == kNoId) continue;
    const Eigen::Vector3d in_camera = camera_from_world * map.FindLandmark(landmarks[k])->in_world;
    const Observation observation = Observe(frame, k, map.model());
    const bool is_inlier = SquaredError(in_camera, observation, map.camera()) <= kChiSquare2Dof95;
    if (!is_inlier) landmarks[k] = kNoId;
    num_inliers += is_inlier;
  }
  return {world_from_camera, std::move(landmarks), num_inliers};
}

}  // namespace corvo
