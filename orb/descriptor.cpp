#include "orb/descriptor.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orb/kernels/window_sums.h"

namespace corvo::orb {

cv::Mat WindowSums(const cv::Mat& image) {
  cv::Mat sums = cv::Mat::zeros(image.size(), CV_16UC1);
  std::vector<std::uint16_t> columns(image.cols);
  for (int y = kWindowRadius; y < image.rows - kWindowRadius; ++y) {
    kernels::SumWindowRow(image.ptr(y), static_cast<std::ptrdiff_t>(image.step), image.cols,
                          columns.data(), sums.ptr<std::uint16_t>(y));
  }
  return sums;
}

Descriptor Describe(const cv::Mat& sums, int x, int y, const Pattern& pattern) {
  const std::uint16_t* centre = sums.ptr<std::uint16_t>(y) + x;
  const auto stride = static_cast<std::ptrdiff_t>(sums.step1());
  const auto sum_at = [&](const Offset& offset) { return centre[offset.y * stride + offset.x]; };
  Descriptor descriptor;
  for (int byte = 0; byte < kNumTests / 8; ++byte) {
    unsigned bits = 0;
    for (int bit = 0; bit < 8; ++bit) {
      const BinaryTest& test = pattern[byte * 8 + bit];
      bits |= static_cast<unsigned>(sum_at(test.p) < sum_at(test.q)) << bit;
    }
    descriptor.bytes[byte] = static_cast<std::uint8_t>(bits);
  }
  return descriptor;
}

}  // namespace corvo::orb
