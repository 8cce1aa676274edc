// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/camera/camera.h"

namespace corvo {

/// Names of the parameters of a model's distortion that are fitted: of a pinhole camera k1 and k2.
std::vector<std::string> DistortionNames(CameraModel model);

/// The focal lengths and principal point of a camera, as one of a model without distortion.
CameraParameters WithoutDistortion(const CameraParameters& camera, CameraModel model);

/// The camera of a model that images as nearly as another one does: least squares of pixels, over a
/// grid of the image, in the focal length and the distortion.
CameraParameters FitCamera(const Camera& camera, CameraModel model);

}  // namespace corvo
