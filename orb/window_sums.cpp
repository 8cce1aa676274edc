// SPDX-License-Identifier: MIT
#include "orb/window_sums.h"

#include <algorithm>

#include "orb/kernels/window_sums.h"

namespace corvo::orb {
namespace {

constexpr int kMargin = 2;  ///< Pixels at the edges without a complete window.

}  // namespace

void WindowSummer::Start(const cv::Mat& image) {
  image_ = &image;
  next_ = kNone;
  columns_.resize(image.cols);
}

void WindowSummer::SumRow(int y, std::uint16_t* sums) {
  const auto stride = static_cast<std::ptrdiff_t>(image_->step);
  const auto sum_columns = y == next_ ? kernels::SlideColumns : kernels::SumColumns;
  sum_columns(image_->ptr(y), stride, image_->cols, columns_.data());
  kernels::SumWindows(columns_.data(), image_->cols, sums);
  next_ = y + 1;
}

cv::Mat WindowSums(const cv::Mat& image) {
  cv::Mat sums = cv::Mat::zeros(image.size(), CV_16UC1);
  WindowSummer summer;
  summer.Start(image);
  for (int y = kMargin; y < image.rows - kMargin; ++y) summer.SumRow(y, sums.ptr<std::uint16_t>(y));
  return sums;
}

void WindowSumBand::Start(const cv::Mat& image) {
  constexpr int kRows = 2 * kReach + 1 + 64;
  image_ = &image;
  summer_.Start(image);
  first_ = end_ = 0;
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
    summer_.SumRow(end_, At(end_));
  }
}

const std::uint16_t* WindowSumBand::Row(int y) {
  if (y - kReach < first_ || y + kReach >= end_) MoveTo(y - kReach);
  return At(y);
}

}  // namespace corvo::orb
