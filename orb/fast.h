// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// A FAST corner: integer pixel and score.
struct Corner {
  int x = 0;
  int y = 0;
  int score = 0;  ///< The largest threshold at which the pixel is still a corner, gray levels.

  bool operator==(const Corner&) const = default;
};

/// FAST-9 corners after 3x3 non-maximum suppression (Rosten and Drummond, "Machine learning for
/// high-speed corner detection", ECCV 2006): pixels with 9 contiguous pixels of the 16 on the
/// circle of radius 3 all brighter than the center by more than `threshold`, or all darker; of
/// these, the ones whose score exceeds that of all 8 neighbors (neighbors of equal score suppress
/// one another). Hence the corners at a higher threshold are those of this score. Keeps its
/// buffers.
class FastDetector {
 public:
  /// `image` is 8-bit, one channel, at most 65535 px wide; `threshold` 1 to 254. Sets `corners` to
  /// those of the whole image that lie in `region`, in row-major order; within 3 px of the image's
  /// edge there are none.
  void Detect(const cv::Mat& image, int threshold, const cv::Rect& region,
              std::vector<Corner>& corners);

 private:
  /// Scores of the image's row `y`; one more on each side.
  std::uint8_t* ScoreRow(int y) { return scores_[y % 3].data() + 1; }
  void AppendMaxima(int y, const cv::Rect& region, std::vector<Corner>& corners);

  std::array<std::vector<std::uint8_t>, 3> scores_;
  std::vector<std::uint16_t> columns_;
};

/// As FastDetector.
std::vector<Corner> DetectFast(const cv::Mat& image, int threshold, const cv::Rect& region);

/// As above, over the whole image.
std::vector<Corner> DetectFast(const cv::Mat& image, int threshold);

}  // namespace corvo::orb
