// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include <opencv2/core/types.hpp>

#include "apps/codecs/codecs.h"

namespace corvo {

/// The sizes of the images of a Motion JPEG video, from its packets. OpenCV converts all images of
/// a video as if they had the size of the first.
class PacketSizes {
 public:
  /// Opens the video a second time, without decoding it.
  explicit PacketSizes(const std::filesystem::path& file);

  /// Returns the size of the next image, or std::nullopt if it is unknown, as it is for all other
  /// codecs.
  std::optional<cv::Size> Next();

 private:
  std::unique_ptr<VideoInput> packets_;  ///< Null if the video is not Motion JPEG.
};

}  // namespace corvo
