#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// Radius of the disc whose moments orient a keypoint: dx^2 + dy^2 <= 15^2, px of its level.
inline constexpr int kMomentRadius = 15;

/// First moments of intensity about a pixel over the disc: sums of dx * I and dy * I.
struct Moments {
  std::int64_t x = 0;
  std::int64_t y = 0;

  bool operator==(const Moments&) const = default;
};

/// `image` is 8-bit, one channel, not smoothed; (x, y) is at least kMomentRadius px from its edges.
Moments MomentsAt(const cv::Mat& image, int x, int y);

/// Direction of the vector (x, y) in degrees, [0, 360), from the x axis towards the y axis; 0 for
/// the null vector. Within 1e-5 degrees of the truth before rounding to float, and free of libm.
float DirectionDeg(double x, double y);

/// Angle of the intensity centroid (Rosin, "Measuring corner properties", 1999), as DirectionDeg.
float OrientationDeg(const cv::Mat& image, int x, int y);

}  // namespace corvo::orb
