// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/dataset/image_reader.h"

namespace corvo {

/// The masks of images, which are 0 where no features are detected.
class MaskSource {
 public:
  /// Creates a source without masks.
  MaskSource() = default;

  /// `path` is one mask for all images, or a folder with one mask per image. The masks of a folder
  /// are assigned by name, ignoring the extension, or by index if none is named like the first
  /// image. Throws corvo::Error if there is no mask.
  MaskSource(const std::filesystem::path& path, const TimedImage& first);

  /// Returns the mask of an image, or an empty matrix for a source without masks. Throws
  /// corvo::Error if the image has no mask or one of another size.
  cv::Mat MaskOf(const TimedImage& image) const;

 private:
  const std::filesystem::path& FileOf(const TimedImage& image) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;  ///< The masks in the folder, if `path_` is one.
  cv::Mat only_;                              ///< The mask for all images, if there is only one.
  bool by_name_ = false;
};

}  // namespace corvo
