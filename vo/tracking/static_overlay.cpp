// SPDX-License-Identifier: MIT
#include "vo/tracking/static_overlay.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace corvo {
namespace {

constexpr double kMaxStillDisplacement = 0.25;  ///< px; noise of a cell.
constexpr double kMinMovedDisplacement = 1;     ///< px
constexpr double kMinMovedShare = 0.4;          ///< Of the textured cells that are not masked.
constexpr int kMinUnmaskedCells = 20;           ///< Textured cells that are not masked.
constexpr int kMinStillImages = 10;
constexpr int kMaxScore = 20;        ///< Bounds how long a masked cell has to move to be released.
constexpr int kMovedPenalty = 3;     ///< A cell that moves by chance is still in the next image.
constexpr int kMaxComparisons = 15;  ///< After these the reference is replaced.

bool IsMoved(const CellMotion& motion) {
  return motion.is_changed || motion.displacement() > kMinMovedDisplacement;
}

}  // namespace

bool StaticOverlay::Add(const ReducedImage& image) {
  if (!reference_) {
    reference_.emplace(image);
    scores_.assign(reference_->num_cells().area(), 0);
    is_overlay_ = cv::Mat_<uchar>::zeros(reference_->num_cells());
    excluded_ = is_overlay_.clone();
    return false;
  }
  if (!CountStill(reference_->Measure(image))) return false;
  ++num_moved_images_;
  if (++num_comparisons_ >= kMaxComparisons) {
    reference_.emplace(image);
    num_comparisons_ = 0;
  }
  return UpdateMask();
}

bool StaticOverlay::CountStill(const std::vector<CellMotion>& motion) {
  int num_textured = 0, num_moved = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (!motion[i].is_textured || excluded_.data[i] != 0) continue;
    ++num_textured;
    num_moved += IsMoved(motion[i]);
  }
  if (num_textured < kMinUnmaskedCells || num_moved < kMinMovedShare * num_textured) return false;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (!motion[i].is_textured) continue;
    const int evidence = motion[i].IsStill(kMaxStillDisplacement) ? 1 : -kMovedPenalty;
    scores_[i] = std::clamp(scores_[i] + evidence, 0, kMaxScore);
  }
  return true;
}

bool StaticOverlay::UpdateMask() {
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    if (scores_[i] >= kMinStillImages) is_overlay_.data[i] = 255;
    if (scores_[i] == 0) is_overlay_.data[i] = 0;
  }
  // Cells without texture inside the overlay, and those that it fills only partly.
  const cv::Mat neighborhood = cv::Mat::ones(3, 3, CV_8U);
  cv::Mat_<uchar> excluded;
  cv::morphologyEx(is_overlay_, excluded, cv::MORPH_CLOSE, neighborhood);
  cv::dilate(excluded, excluded, neighborhood);
  const bool has_grown = cv::countNonZero(excluded & ~excluded_) > 0;
  excluded_ = excluded;
  return has_grown;
}

double StaticOverlay::masked_share() const {
  return excluded_.empty() ? 0
                           : cv::countNonZero(excluded_) / static_cast<double>(excluded_.total());
}

cv::Mat StaticOverlay::Exclude(const cv::Mat& mask, const cv::Size& image_size) const {
  if (excluded_.empty() || cv::countNonZero(excluded_) == 0) return mask;
  const int cell = CellDisplacement::kCellSize * reference_->reference().factor;
  cv::Mat used(image_size, CV_8U, cv::Scalar(255));
  for (int y = 0; y < image_size.height; y += cell) {
    for (int x = 0; x < image_size.width; x += cell) {
      const int row = std::min(y / cell, excluded_.rows - 1);
      const int column = std::min(x / cell, excluded_.cols - 1);
      if (excluded_(row, column) == 0) continue;
      used(cv::Rect(x, y, cell, cell) & cv::Rect(cv::Point(), image_size)) = 0;
    }
  }
  if (!mask.empty()) cv::bitwise_and(mask, used, used);
  return used;
}

}  // namespace corvo
