// SPDX-License-Identifier: MIT
#include "orb/window_sums.h"

#include <algorithm>

#include "orb/kernels/window_sums.h"

namespace corvo::orb {
namespace {

constexpr int kMargin = 2;  ///< Pixels at the edges without a complete window.

void SumRow(const cv::Mat& image, int y, std::vector<std::uint16_t>& columns, std::uint16_t* sums) {
  kernels::SumWindowRow(image.ptr(y), static_cast<std::ptrdiff_t>(image.step), image.cols,
                        columns.data(), sums);
}

}  // namespace

cv::Mat WindowSums(const cv::Mat& image) {
  cv::Mat sums = cv::Mat::zeros(image.size(), CV_16UC1);
  std::vector<std::uint16_t> columns(image.cols);
  for (int y = kMargin; y < image.rows - kMargin; ++y) {
    SumRow(image, y, columns, sums.ptr<std::uint16_t>(y));
  }
  return sums;
}

void WindowSumBand::Start(const cv::Mat& image) {
  constexpr int kRows = 2 * kReach + 1 + 64;
  image_ = &image;
  first_ = end_ = 0;
  columns_.resize(image.cols);
  sums_.resize(static_cast<std::size_t>(kRows) * image.cols);
}

void WindowSumBand::MoveTo(int first) {
  const std::uint16_t* held_end = At(end_);
  if (first >= first_ && first < end_) {
    std::copy(static_cast<const std::uint16_t*>(At(first)), held_end, sums_.data());
  } else {
    end_ = first;
  }
  first_ = first;
  const int num_rows = static_cast<int>(std::ssize(sums_) / stride());
  for (const int end = std::min(first_ + num_rows, image_->rows - kMargin); end_ < end; ++end_) {
    SumRow(*image_, end_, columns_, At(end_));
  }
}

const std::uint16_t* WindowSumBand::Row(int y) {
  if (y - kReach < first_ || y + kReach >= end_) MoveTo(y - kReach);
  return At(y);
}

}  // namespace corvo::orb
