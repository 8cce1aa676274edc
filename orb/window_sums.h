// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// Returns the sums over the 5x5 window centered at each pixel, 16-bit, one channel; the outer 2 px
/// are 0. `image` is 8-bit, one channel.
cv::Mat WindowSums(const cv::Mat& image);

/// Computes single rows of WindowSums(). Not thread-safe.
class WindowSummer {
 public:
  /// Starts with another image, which must outlive the calls of SumRow().
  void Start(const cv::Mat& image);

  /// Sets sums[x] for the columns x, 2 px from the edges, of row `y`, which is as far from them.
  /// Efficient if each row is the next.
  void SumRow(int y, std::uint16_t* sums);

 private:
  static constexpr int kNone = -1;

  const cv::Mat* image_ = nullptr;
  int next_ = kNone;                    ///< The row after that of columns_.
  std::vector<std::uint16_t> columns_;  ///< Sums over the columns of the windows of a row.
};

/// Computes the rows of WindowSums() on demand, in a reused buffer. Not thread-safe.
class WindowSumBand {
 public:
  static constexpr int kReach = 18;  ///< Rows available above and below a requested row.

  /// Starts with another image, which must outlive the calls of Row().
  void Start(const cv::Mat& image);

  /// Returns the sums of row `y`; the sums of the rows up to kReach away are at multiples of
  /// stride() elements. `y` is at least kReach + 2 from the image's edges. Efficient if rows are
  /// requested in ascending order.
  const std::uint16_t* Row(int y);

  std::ptrdiff_t stride() const { return image_->cols; }

 private:
  /// Keeps the available rows from `first` on, and sums more rows until the buffer is full.
  void MoveTo(int first);
  std::uint16_t* At(int y) { return sums_.data() + (y - first_) * stride(); }

  const cv::Mat* image_ = nullptr;
  WindowSummer summer_;
  int first_ = 0;  ///< The buffer holds rows [first_, end_).
  int end_ = 0;
  std::vector<std::uint16_t> sums_;
};

}  // namespace corvo::orb
