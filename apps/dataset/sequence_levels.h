// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "apps/dataset/gray_levels.h"

namespace corvo {

/// The images of a sequence as they are stored, for finding their gray levels.
struct StoredImages {
  std::string name;  ///< For messages.
  int count = 0;
  /// Returns the image with an index, 8- or 16-bit gray. It is called with ascending indices, and
  /// throws corvo::Error if the image cannot be read.
  std::function<cv::Mat(int)> read;
};

/// The conversion of the images of a sequence to 8 bits. The map of 16-bit images is found with the
/// first of them, from eight images all over the sequence, so that it is the same for every
/// selection.
class SequenceLevels {
 public:
  /// With `bits` (8 to 16), these are used of 16-bit images. Throws corvo::Error if it is out of
  /// range.
  SequenceLevels(StoredImages stored, std::optional<int> bits);

  /// Converts an 8- or 16-bit gray image of the sequence.
  cv::Mat ToByte(const cv::Mat& image);

  /// Returns the map, or std::nullopt before the first 16-bit image.
  const std::optional<GrayLevels>& levels() const { return levels_; }

 private:
  GrayLevels Find() const;

  StoredImages stored_;
  std::optional<GrayLevels> stated_;
  std::optional<GrayLevels> levels_;
};

}  // namespace corvo
