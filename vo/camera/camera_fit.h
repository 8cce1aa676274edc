// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/camera/camera.h"

namespace corvo {

/// Returns the names of the distortion parameters that are fitted; for a pinhole camera k1 and k2.
std::vector<std::string> DistortionNames(CameraModel model);

/// Returns a camera of `model` with the focal lengths and principal point of `camera` and without
/// distortion parameters.
CameraParameters WithoutDistortion(const CameraParameters& camera, CameraModel model);

/// Returns the camera of `model` that best approximates `camera`: the least squares of pixel errors
/// over a grid of the image, in the focal length and the distortion.
CameraParameters FitCamera(const Camera& camera, CameraModel model);

}  // namespace corvo
