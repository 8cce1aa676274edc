// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/optimization/landmark_pose.h"

namespace corvo {

/// Returns the optimal pose over the landmarks that the keypoints of a frame observe, starting at
/// the frame's pose, with its inliers.
///
/// If so many are outliers that a second rigid motion may compete with that of the scene (a vehicle
/// that fills much of the view), the motion that agrees with the past of the map wins: landmarks
/// created on a moving object agree with the motion of the object, but only since their creation.
/// Established landmarks, which have been found in most of many frames, then determine a pose of
/// their own. It is returned if most of them agree with it, and if many of these contradict the
/// pose of all landmarks.
LandmarkPose FindRigidConsensus(const Map& map, const Frame& frame,
                                const PoseOptimizerOptions& options);

/// Returns the keypoints whose landmarks contradict the consensus, or none if these are no more
/// than noise explains.
std::vector<int> FindContradictions(const Frame& frame, const LandmarkPose& consensus);

}  // namespace corvo
