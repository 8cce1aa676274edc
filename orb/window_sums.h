// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// Sums over the 5x5 window centered at each pixel, 16-bit, one channel; the outer 2 px are 0.
/// `image` is 8-bit, one channel.
cv::Mat WindowSums(const cv::Mat& image);

/// The same, only around the rows asked for, in a buffer that is kept.
class WindowSumBand {
 public:
  static constexpr int kReach = 18;  ///< Rows above and below.

  /// Begins with another image, which must live as long as it is asked about.
  void Start(const cv::Mat& image);

  /// The sums of row `y`; those of the rows up to kReach away are stride() numbers apart. `y` is at
  /// least kReach + 2 from the image's edges. Cheap if rows are asked for in ascending order.
  const std::uint16_t* Row(int y);

  std::ptrdiff_t stride() const { return image_->cols; }

 private:
  /// Keeps what it has of the rows from `first` on, and sums as many more as there is room for.
  void MoveTo(int first);
  std::uint16_t* At(int y) { return sums_.data() + (y - first_) * stride(); }

  const cv::Mat* image_ = nullptr;
  int first_ = 0;  ///< Rows [first_, end_) are held.
  int end_ = 0;
  std::vector<std::uint16_t> sums_;
  std::vector<std::uint16_t> columns_;
};

}  // namespace corvo::orb
