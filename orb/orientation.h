// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/mat.hpp>

#include "orb/kernels/moments.h"

namespace corvo::orb {

/// First moments of intensity over the disc of radius 15 px about a pixel. `image` is 8-bit, one
/// channel, not smoothed; (x, y) is at least 16 px from its edges.
kernels::DiscMoments MomentsAt(const cv::Mat& image, int x, int y);

/// Direction of the vector (x, y) in degrees, as kernels::FindDirectionsDeg.
float DirectionDeg(double x, double y);

/// Angle of the intensity centroid (Rosin, "Measuring corner properties", 1999): the direction of
/// MomentsAt().
float OrientationDeg(const cv::Mat& image, int x, int y);

}  // namespace corvo::orb
