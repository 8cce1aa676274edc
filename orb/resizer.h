// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/kernels/resize.h"

namespace corvo::orb {

/// Resizes 8-bit images of one size by bilinear interpolation at the pixel centers of another size,
/// with weights in units of 1/128 and a single exact rounding at the end. Resizing commutes with
/// mirroring and with rotation by 90 degrees, bit for bit. It is meant for shrinking by a factor of
/// up to 2; beyond that it skips pixels.
class Resizer {
 public:
  Resizer() = default;
  Resizer(cv::Size from, cv::Size to);

  cv::Size from() const { return from_; }
  cv::Size to() const { return to_; }

  /// The two rows of `image` last interpolated horizontally, kept for reuse by the next row.
  struct RowCache {
    std::array<std::vector<std::int16_t>, 2> rows;
    std::array<int, 2> held;
  };

  /// Computes rows [begin, end) of `resized`, which must have the right size and type. Any
  /// partition of the rows gives the same image.
  void ResizeRows(const cv::Mat& image, int begin, int end, RowCache& cache,
                  cv::Mat& resized) const;

 private:
  /// A target value is ((1 - weight / 128) * source[index] + weight / 128 * source[next]); weight <
  /// 128.
  struct Tap {
    int index = 0;
    int next = 0;
    int weight = 0;
  };

  static std::vector<Tap> MakeTaps(int source, int target);
  static Tap TapAt(int i, int source, int target);

  /// The data that kernels::TapGroups points to.
  struct ColumnTaps {
    std::vector<std::uint8_t> taps;
    std::vector<std::uint8_t> weights;
    std::vector<std::int32_t> bases;
    bool are_near = true;  ///< All within kernels::kTapReach of their base.
  };

  static ColumnTaps GroupTaps(std::vector<Tap> taps, int source);
  const std::int16_t* InterpolatedRow(const cv::Mat& image, int y, RowCache& cache) const;

  cv::Size from_;
  cv::Size to_;
  std::vector<Tap> row_taps_;
  ColumnTaps column_taps_;
};

/// Returns `image` resized to `size`.
cv::Mat Resize(const cv::Mat& image, cv::Size size);

}  // namespace corvo::orb
