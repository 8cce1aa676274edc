#pragma once

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// Direction of the vector (x, y) in degrees, [0, 360), from the x axis towards the y axis; 0 for
/// the null vector. Within 1e-5 degrees of the truth before rounding to float, and free of libm.
float DirectionDeg(double x, double y);

/// Angle of the intensity centroid over the disc of radius 15 px about a pixel (Rosin, "Measuring
/// corner properties", 1999), as DirectionDeg. `image` is 8-bit, one channel, not smoothed; (x, y)
/// is at least 16 px from its edges.
float OrientationDeg(const cv::Mat& image, int x, int y);

}  // namespace corvo::orb
