// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// A camera in COLMAP's terms: https://colmap.github.io/cameras.html.
struct ColmapCamera {
  int model_id = 0;
  std::string model;               ///< "PINHOLE", "OPENCV", "FULL_OPENCV", "OPENCV_FISHEYE", "FOV".
  std::vector<double> parameters;  ///< In COLMAP's order. Its principal point is half a pixel
                                   ///< larger: the corner of the first pixel is at the origin.
};

/// Returns the simplest of COLMAP's models that projects every point as `camera` does.
ColmapCamera ToColmap(const CameraParameters& camera);

}  // namespace corvo
