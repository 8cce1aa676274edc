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

Describer::Describer(const Pattern& pattern, int bins, bool upright)
    : patterns_(pattern, bins), upright_(upright), tests_(bins) {
  for (int bin = 0; bin < bins; ++bin) {
    for (int i = 0; i < kNumTests; ++i) {
      const BinaryTest& test = patterns_[bin][i];
      tests_[bin].p[i] = kernels::PatchIndex(test.p.x, test.p.y);
      tests_[bin].q[i] = kernels::PatchIndex(test.q.x, test.q.y);
    }
  }
}

Descriptor Describer::Describe(const cv::Mat& image, int x, int y, float angle_deg) const {
  const int bin = upright_ ? 0 : patterns_.NearestBin(angle_deg);
  Descriptor descriptor;
  kernels::TestPatch(image.ptr(y) + x, static_cast<std::ptrdiff_t>(image.step), tests_[bin],
                     descriptor.bytes.data());
  return descriptor;
}

}  // namespace corvo::orb
