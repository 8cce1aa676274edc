// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// Throws corvo::Error, naming field, value, allowed range and the likely mistake, if a valid
/// camera cannot be that of its images: a focal length below 5 px, or a principal point that is 0
/// or outside of the image.
void CheckPlausible(const CameraParameters& camera);

/// Returns a sentence for each value that is possible but unusual, naming the likely mistake: a
/// principal point farther than 20% of the image width from the center, or a field of view of a
/// pinhole camera outside 5 to 150 degrees, of a kb4 camera outside 5 to 360 degrees along an axis.
/// Distortion is neglected. Empty for a usual camera.
std::vector<std::string> UnusualValues(const CameraParameters& camera);

}  // namespace corvo
