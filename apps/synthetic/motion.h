// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "apps/synthetic/sequence.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// The position (m) and the orientation (rad) of a camera in a scene.
struct Viewpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0;    ///< Heading of the optical axis, from the scene's x towards y.
  double pitch = 0;  ///< Elevation of the optical axis, positive upwards.
  double roll = 0;   ///< Rotation about the optical axis, positive clockwise.
};

SE3 SceneFromCamera(const Viewpoint& viewpoint);

/// Returns the viewpoint with the shake of a hand-held camera: 5 mm and a third of a degree.
Viewpoint ShakenByHand(Viewpoint viewpoint, double seconds);

/// Returns `options.camera` if given, otherwise `camera` scaled to `options.width`. Throws
/// corvo::Error if the options are out of range.
Camera ChooseCamera(const CameraParameters& camera, const SequenceOptions& options);

}  // namespace corvo::synthetic
