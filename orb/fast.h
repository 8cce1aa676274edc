// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// A FAST corner: an integer pixel and a score.
struct Corner {
  int x = 0;
  int y = 0;
  int score = 0;  ///< The largest threshold at which the pixel is a corner, gray levels.

  bool operator==(const Corner&) const = default;
};

/// Detects FAST-9 corners with 3x3 non-maximum suppression (Rosten and Drummond, "Machine learning
/// for high-speed corner detection", ECCV 2006). A corner has 9 contiguous pixels, out of the 16 on
/// the circle of radius 3, that are all brighter than the center by more than `threshold`, or all
/// darker. Only corners whose score exceeds that of all 8 neighbors are kept (neighbors of equal
/// score suppress each other). The corners at a higher threshold are therefore exactly those whose
/// score reaches it. Keeps its buffers; not thread-safe.
class FastDetector {
 public:
  /// Sets `corners` to the corners of the whole image that lie in `region`, in row-major order.
  /// There are none within 3 px of the image's edges. `image` is 8-bit, one channel, at most 65535
  /// px wide; `threshold` is 1 to 254.
  void Detect(const cv::Mat& image, int threshold, const cv::Rect& region,
              std::vector<Corner>& corners);

 private:
  /// Returns the scores of image row `y`, with one more element on each side.
  std::uint8_t* ScoreRow(int y) { return scores_[y % 3].data() + 1; }
  void AppendMaxima(int y, const cv::Rect& region, std::vector<Corner>& corners);

  std::array<std::vector<std::uint8_t>, 3> scores_;
  std::vector<std::uint16_t> columns_;
};

/// Returns the corners that FastDetector::Detect() finds in `region`.
std::vector<Corner> DetectFast(const cv::Mat& image, int threshold, const cv::Rect& region);

/// Returns the corners of the whole image.
std::vector<Corner> DetectFast(const cv::Mat& image, int threshold);

}  // namespace corvo::orb
