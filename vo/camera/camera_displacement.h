// SPDX-License-Identifier: MIT
#pragma once

#include "vo/camera/camera.h"

namespace corvo {

/// Returns the largest distance between a pixel of a camera and the pixel that its ray has in
/// another camera, over a grid of the image; px. Pixels without a ray in both do not count.
double LargestDisplacement(const Camera& from, const Camera& to);

}  // namespace corvo
