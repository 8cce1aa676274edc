// SPDX-License-Identifier: MIT
#pragma once

#include "vo/camera/camera.h"
#include "vo/core/frame_result.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/optimization/pose_dependence.h"

namespace corvo {

/// Returns the share of the cells of a grid of 8 x 6 over the image that hold a keypoint with a
/// landmark.
double ImageCoverage(const Frame& frame, const Camera& camera);

/// Returns the health of a pose with this covariance relative to its reference, without
/// `found_share`. `factor` is the measured variance of the landmarks in units of that of the
/// measurement model.
PoseHealth AssessPose(const Frame& frame, const Camera& camera, const PoseDependence& dependence,
                      double factor, const SE3::Matrix6& covariance);

}  // namespace corvo
