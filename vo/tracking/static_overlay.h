// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vo/tracking/cell_displacement.h"

namespace corvo {

/// Finds texture that stays in place in the image while the scene moves: a bonnet, a robot arm, a
/// text overlay, dirt on the lens. A cell is masked after it has been still in ten images in which
/// most of the other cells had moved against a common reference image, and is released when it
/// moves.
class StaticOverlay {
 public:
  /// Takes an image that does not repeat the one before. Returns whether the mask has grown.
  bool Add(const ReducedImage& image);

  /// Number of images in which most of what is not masked had moved.
  int num_moved_images() const { return num_moved_images_; }
  /// Share of the image's cells that are masked, 0 to 1.
  double masked_share() const;
  /// `mask` without the overlay. A mask is empty or 8-bit, of the size of the images and zero where
  /// the image must not be used.
  cv::Mat Exclude(const cv::Mat& mask, const cv::Size& image_size) const;

 private:
  /// Counts evidence for and against every textured cell. Returns whether the scene has moved.
  bool CountStill(const std::vector<CellMotion>& motion);
  /// Returns whether cells were added.
  bool UpdateMask();

  std::optional<CellDisplacement> reference_;
  std::vector<int> scores_;     // Per cell.
  cv::Mat_<uchar> is_overlay_;  // Per cell: 255 where `scores_` have reached the limit.
  cv::Mat_<uchar> excluded_;    // Per cell: the overlay with its holes and its margin.
  int num_comparisons_ = 0;     // With the present reference, while the scene moved.
  int num_moved_images_ = 0;    // With all references.
};

}  // namespace corvo
