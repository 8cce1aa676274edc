// SPDX-License-Identifier: MIT
#pragma once

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// Returns a pinhole camera without distortion, with fx = fy = `focal_px` and the principal point
/// in the image center.
CameraParameters CenteredPinhole(double focal_px, int width, int height);

/// Returns the focal length of a pinhole camera whose horizontal field of view is `fov_deg`, in the
/// unit of `width`: f = width / 2 / tan(fov / 2).
double FocalOfFov(double fov_deg, double width);

/// Returns the inverse of FocalOfFov(), in degrees.
double FovOfFocal(double focal, double width);

}  // namespace corvo
