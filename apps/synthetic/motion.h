// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "apps/synthetic/sequence.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// Where a camera stands in a scene and where it looks. rad, m.
struct Viewpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0;    ///< Of the optical axis about the vertical, from the scene's x towards y.
  double pitch = 0;  ///< Upwards.
  double roll = 0;   ///< Clockwise about the optical axis.
};

SE3 SceneFromCamera(const Viewpoint& viewpoint);

/// The viewpoint, shaken as a walking person shakes a camera: 5 mm and a third of a degree.
Viewpoint ShakenByHand(Viewpoint viewpoint, double seconds);

/// `camera` scaled to `options.width`, or what `options.camera` says instead. Throws corvo::Error
/// on options out of range.
Camera ChooseCamera(const CameraParameters& camera, const SequenceOptions& options);

}  // namespace corvo::synthetic
