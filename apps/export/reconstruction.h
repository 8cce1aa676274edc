// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vo/camera/camera_parameters.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"

namespace corvo {

/// The observation of a point in an image.
struct PointObservation {
  int point = 0;          ///< Index into Reconstruction::points.
  Eigen::Vector2d pixel;  ///< px; integers are pixel centers.
  double sigma_px = 1;    ///< Standard deviation along each axis.
};

/// A posed image with its observations.
struct ReconstructedImage {
  int frame = 0;     ///< Index of the input frame.
  std::string name;  ///< Name of the image file.
  SE3 world_from_camera;
  std::vector<PointObservation> observations;
};

/// A 3-D point.
struct ReconstructedPoint {
  LandmarkId id = kNoId;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> rgb = {160, 160, 160};
};

/// The camera, poses and points of one segment, as programs for structure from motion exchange
/// them.
struct Reconstruction {
  CameraParameters camera;
  std::vector<ReconstructedImage> images;
  std::vector<ReconstructedPoint> points;
};

}  // namespace corvo
