// SPDX-License-Identifier: MIT
#include "orb/fast.h"

#include <algorithm>

#include "orb/kernels/fast_score.h"

namespace corvo::orb {
namespace {

using kernels::kCircleRadius;

/// Returns the area in which scores are computed: the region and one pixel around it, so that
/// suppression works at its edge, except where the circle would leave the image.
cv::Rect ScoredArea(const cv::Mat& image, const cv::Rect& region) {
  const cv::Rect grown(region.x - 1, region.y - 1, region.width + 2, region.height + 2);
  return grown & cv::Rect(kCircleRadius, kCircleRadius, std::max(0, image.cols - 2 * kCircleRadius),
                          std::max(0, image.rows - 2 * kCircleRadius));
}

}  // namespace

void FastDetector::Detect(const cv::Mat& image, int threshold, const cv::Rect& region,
                          std::vector<Corner>& corners) {
  corners.clear();
  const cv::Rect inside = region & cv::Rect(0, 0, image.cols, image.rows);
  const cv::Rect scored = ScoredArea(image, inside);
  if (inside.empty() || scored.empty()) return;
  for (std::vector<std::uint8_t>& row : scores_) row.assign(image.cols + 2, 0);
  columns_.resize(image.cols + kernels::kMaximaRoom);
  const auto stride = static_cast<std::ptrdiff_t>(image.step);
  for (int y = scored.y; y < scored.br().y; ++y) {
    kernels::ScoreFastRow(image.ptr(y) + scored.x, stride, scored.width, threshold,
                          ScoreRow(y) + scored.x);
    if (y > scored.y) AppendMaxima(y - 1, inside, corners);
  }
  std::fill_n(ScoreRow(scored.br().y), image.cols, std::uint8_t{0});
  AppendMaxima(scored.br().y - 1, inside, corners);
}

void FastDetector::AppendMaxima(int y, const cv::Rect& region, std::vector<Corner>& corners) {
  if (y < region.y || y >= region.br().y) return;
  const std::uint8_t* here = ScoreRow(y);
  const int count =
      kernels::FindRowMaxima(ScoreRow(y + 2) + region.x, here + region.x,  // y - 1 modulo 3
                             ScoreRow(y + 1) + region.x, region.width, columns_.data());
  for (int i = 0; i < count; ++i) {
    const int x = region.x + columns_[i];
    corners.push_back({x, y, here[x]});
  }
}

std::vector<Corner> DetectFast(const cv::Mat& image, int threshold, const cv::Rect& region) {
  std::vector<Corner> corners;
  FastDetector().Detect(image, threshold, region, corners);
  return corners;
}

std::vector<Corner> DetectFast(const cv::Mat& image, int threshold) {
  return DetectFast(image, threshold, cv::Rect(0, 0, image.cols, image.rows));
}

}  // namespace corvo::orb
