// SPDX-License-Identifier: MIT
#include "orb/orientation.h"

#include <cstddef>

#include "orb/kernels/directions.h"

namespace corvo::orb {

kernels::DiscMoments MomentsAt(const cv::Mat& image, int x, int y) {
  return kernels::SumDiscMoments(image.ptr(y) + x, static_cast<std::ptrdiff_t>(image.step));
}

float DirectionDeg(double x, double y) { return kernels::scalar::DirectionDeg(x, y); }

float OrientationDeg(const cv::Mat& image, int x, int y) {
  const kernels::DiscMoments moments = MomentsAt(image, x, y);
  return DirectionDeg(moments.x, moments.y);
}

}  // namespace corvo::orb
