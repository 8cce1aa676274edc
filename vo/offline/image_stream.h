// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"

namespace corvo {

/// An input image of Odometry::Process().
struct StreamImage {
  cv::Mat image;  ///< 8-bit gray; ignored if it is missing.
  TimeNs time_ns = 0;
  cv::Mat mask;      ///< Empty, or of the image's size.
  std::string name;  ///< Name of the image in messages.
  /// Why the image is missing, as for Odometry::ProcessMissing(); kNone if it is not.
  Reason missing = Reason::kNone;
};

/// The images of one sequence, read one after the other.
class ImageStream {
 public:
  ImageStream() = default;
  ImageStream(const ImageStream&) = delete;
  ImageStream& operator=(const ImageStream&) = delete;
  virtual ~ImageStream() = default;

  /// Returns the next image, or std::nullopt after the last. May throw corvo::Error.
  virtual std::optional<StreamImage> Next() = 0;
  /// Skips the next image without decoding it. Returns false after the last.
  virtual bool Skip() = 0;
  /// Returns the number of images, or std::nullopt if it is known only at their end.
  virtual std::optional<int> size() const { return std::nullopt; }
};

/// Opens a sequence at its first image, every time that it is called.
using StreamOpener = std::function<std::unique_ptr<ImageStream>()>;

}  // namespace corvo
