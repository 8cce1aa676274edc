// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/mat.hpp>

#include "orb/kernels/moments.h"

namespace corvo::orb {

/// Returns the first moments of intensity over the disc of radius 15 px around a pixel. `image` is
/// 8-bit, one channel, not smoothed; (x, y) is at least 16 px from its edges.
kernels::DiscMoments MomentsAt(const cv::Mat& image, int x, int y);

/// Returns the direction of the vector (x, y) in degrees, like kernels::FindDirectionsDeg().
float DirectionDeg(double x, double y);

/// Returns the angle of the intensity centroid (Rosin, "Measuring corner properties", 1999) in
/// degrees: the direction of MomentsAt().
float OrientationDeg(const cv::Mat& image, int x, int y);

}  // namespace corvo::orb
