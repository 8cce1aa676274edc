// SPDX-License-Identifier: MIT
#include "orb/level_detail.h"

#include <cmath>
#include <cstdint>

#include "orb/kernels/gradients.h"

namespace corvo::orb {
namespace {

/// Root mean square difference of neighboring pixels, right and below, over every fourth row.
double RootMeanSquareGradient(const cv::Mat& image) {
  constexpr int kRowStep = 4;
  std::int64_t sum = 0, count = 0;
  for (int y = 0; y + 1 < image.rows; y += kRowStep) {
    sum += kernels::SumSquaredGradients(image.ptr(y), image.ptr(y + 1), image.cols - 1);
    count += image.cols - 1;
  }
  return count == 0 ? 0 : std::sqrt(static_cast<double>(sum) / static_cast<double>(count));
}

}  // namespace

int FindFirstDetailedLevel(const std::vector<PyramidLevel>& levels, double min_detail) {
  const int num_levels = static_cast<int>(levels.size());
  int half = 0;
  for (int level = 0; level < num_levels; ++level) {
    while (half < num_levels && levels[half].ratio_x < 2 * levels[level].ratio_x) ++half;
    if (half == num_levels) return level;
    const double coarse = RootMeanSquareGradient(levels[half].image);
    if (RootMeanSquareGradient(levels[level].image) >= min_detail * coarse) return level;
  }
  return 0;
}

}  // namespace corvo::orb
