// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/dataset/image_reader.h"

namespace corvo {

/// Masks of images: 0 where no features are wanted.
class MaskSource {
 public:
  /// No masks.
  MaskSource() = default;

  /// An image for all frames, or a folder with one for each: by name (the image's, the extension
  /// apart), or in their order where no name fits the first image's. Throws corvo::Error where
  /// there is none.
  MaskSource(const std::filesystem::path& path, const TimedImage& first);

  /// Empty if there are no masks. Throws corvo::Error where the image has none, or one of another
  /// size.
  cv::Mat MaskOf(const TimedImage& image) const;

 private:
  const std::filesystem::path& FileOf(const TimedImage& image) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;  ///< Of a folder.
  cv::Mat only_;                              ///< The one for all frames.
  bool by_name_ = false;
};

}  // namespace corvo
