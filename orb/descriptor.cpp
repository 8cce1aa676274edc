#include "orb/descriptor.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace corvo::orb {
namespace {

/// Sums of each column over the 5 rows around row `y`.
void SumColumns(const cv::Mat& image, int y, std::uint16_t* __restrict sums) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step);
  const std::uint8_t* row = image.ptr<std::uint8_t>(y);
  for (int x = 0; x < image.cols; ++x) {
    const int sum =
        row[x - 2 * stride] + row[x - stride] + row[x] + row[x + stride] + row[x + 2 * stride];
    sums[x] = static_cast<std::uint16_t>(sum);
  }
}

void SumAcross(const std::uint16_t* columns, int width, std::uint16_t* __restrict sums) {
  for (int x = kWindowRadius; x < width - kWindowRadius; ++x) {
    sums[x] = static_cast<std::uint16_t>(columns[x - 2] + columns[x - 1] + columns[x] +
                                         columns[x + 1] + columns[x + 2]);
  }
}

}  // namespace

cv::Mat WindowSums(const cv::Mat& image) {
  cv::Mat sums = cv::Mat::zeros(image.size(), CV_16UC1);
  std::vector<std::uint16_t> columns(image.cols);
  for (int y = kWindowRadius; y < image.rows - kWindowRadius; ++y) {
    SumColumns(image, y, columns.data());
    SumAcross(columns.data(), image.cols, sums.ptr<std::uint16_t>(y));
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
