// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/kernels/resize.h"

namespace corvo::orb {

/// Bilinear interpolation of 8-bit images of one size at the pixel centers of another, with weights
/// of 1/128 px and one exact rounding at the end. It commutes with mirroring and with rotation by
/// 90 degrees, bit for bit. Meant for shrinking by up to 2: beyond that it skips pixels.
class Resizer {
 public:
  Resizer() = default;
  Resizer(cv::Size from, cv::Size to);

  cv::Size from() const { return from_; }
  cv::Size to() const { return to_; }

  /// The two rows of `image` last interpolated across, to be used again for the next row.
  struct RowCache {
    std::array<std::vector<std::int16_t>, 2> rows;
    std::array<int, 2> held;
  };

  /// Sets rows [begin, end) of `resized`, which has the right size and type. Any partition of the
  /// rows gives the same image.
  void ResizeRows(const cv::Mat& image, int begin, int end, RowCache& cache,
                  cv::Mat& resized) const;

 private:
  /// Value = ((1 - weight / 128) * source[index] + weight / 128 * source[next]); weight < 128.
  struct Tap {
    int index = 0;
    int next = 0;
    int weight = 0;
  };

  static std::vector<Tap> MakeTaps(int source, int target);
  static Tap TapAt(int i, int source, int target);

  /// What kernels::TapGroups points at.
  struct ColumnTaps {
    std::vector<std::uint8_t> first;
    std::vector<std::uint8_t> second;
    std::vector<std::int16_t> weights;
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

/// `image` resized whole.
cv::Mat Resize(const cv::Mat& image, cv::Size size);

}  // namespace corvo::orb
