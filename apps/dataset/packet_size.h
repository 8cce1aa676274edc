// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include <opencv2/core/types.hpp>
#include <opencv2/videoio.hpp>

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
  cv::VideoCapture packets_;
};

}  // namespace corvo
