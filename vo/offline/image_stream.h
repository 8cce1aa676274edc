// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vo/core/conventions.h"

namespace corvo {

/// An image as Odometry::Process takes it.
struct StreamImage {
  cv::Mat image;  ///< 8-bit gray.
  TimeNs time_ns = 0;
  cv::Mat mask;      ///< Empty, or of the image's size.
  std::string name;  ///< For messages.
};

/// The images of one sequence, read one after the other.
class ImageStream {
 public:
  ImageStream() = default;
  ImageStream(const ImageStream&) = delete;
  ImageStream& operator=(const ImageStream&) = delete;
  virtual ~ImageStream() = default;

  /// The next image; none after the last. May throw corvo::Error.
  virtual std::optional<StreamImage> Next() = 0;
  /// Leaves out the next image, undecoded; false after the last.
  virtual bool Skip() = 0;
  /// How many images there are; none where only their end will tell.
  virtual std::optional<int> size() const { return std::nullopt; }
};

/// Opens a sequence at its first image, as often as it is called.
using StreamOpener = std::function<std::unique_ptr<ImageStream>()>;

}  // namespace corvo
