// SPDX-License-Identifier: MIT
#include "apps/dataset/gray_levels.h"

#include <algorithm>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr int kNumLevels = 1 << 16;

}  // namespace

GrayLevels::GrayLevels(int bits) : levels_(kNumLevels), bits_(bits) {
  CheckRange("bits", bits, 8, 16);
  high_ = (1 << bits) - 1;
  for (int level = 0; level < kNumLevels; ++level) {
    levels_[level] = static_cast<std::uint8_t>(std::min(level >> (bits - 8), 255));
  }
}

GrayLevels::GrayLevels(int low, int high) : levels_(kNumLevels), low_(low), high_(high) {
  const int span = std::max(high - low, 1);
  for (int level = 0; level < kNumLevels; ++level) {
    const int above = std::clamp(level - low, 0, span);
    levels_[level] = static_cast<std::uint8_t>((255 * above + span / 2) / span);
  }
}

std::string GrayLevels::text() const {
  return bits_ ? fmt::format("{} bits", *bits_) : fmt::format("levels {} to {}", low_, high_);
}

cv::Mat GrayLevels::ToByte(const cv::Mat& image) const {
  if (image.depth() != CV_16U) return image;
  cv::Mat bytes(image.size(), CV_8UC(image.channels()));
  const int row_size = image.cols * image.channels();
  for (int y = 0; y < image.rows; ++y) {
    const auto* const row = image.ptr<std::uint16_t>(y);
    std::transform(row, row + row_size, bytes.ptr<std::uint8_t>(y),
                   [this](std::uint16_t level) { return Of(level); });
  }
  return bytes;
}

void GrayHistogram::Add(const cv::Mat& image) {
  for (int y = 0; y < image.rows; ++y) {
    const auto* const row = image.ptr<std::uint16_t>(y);
    for (int x = 0; x < image.cols; ++x) ++counts_[row[x]];
  }
  num_pixels_ += static_cast<std::int64_t>(image.total());
}

int GrayHistogram::Percentile(double share) const {
  const auto rank = static_cast<std::int64_t>(share * static_cast<double>(num_pixels_));
  std::int64_t num_below = 0;
  int level = 0;
  while (level < kNumLevels - 1 && (num_below += counts_[level]) <= rank) ++level;
  return level;
}

GrayLevels GrayHistogram::Levels() const {
  const auto greatest =
      std::find_if(counts_.rbegin(), counts_.rend(), [](auto n) { return n > 0; });
  const auto end = static_cast<int>(counts_.rend() - greatest);
  int bits = 10;
  while (bits < 16 && end > 1 << bits) bits += 2;
  const int low = Percentile(0.001);
  const int high = Percentile(0.999);
  if (num_pixels_ == 0 || 4 * (high - low) >= 1 << bits) return GrayLevels(bits);
  const int margin = std::max((high - low) / 10, 1);
  return {std::max(low - margin, 0), std::min(high + margin, kNumLevels - 1)};
}

}  // namespace corvo
