// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vo/core/conventions.h"

namespace corvo {

struct TimedFile {
  std::filesystem::path file;
  TimeNs time_ns = 0;
};

struct TimedImage {
  cv::Mat image;  ///< 8-bit gray.
  cv::Mat mask;   ///< Empty, or of the image's size: features are found where it is not 0.
  TimeNs time_ns = 0;
  int index = 0;     ///< In the whole sequence, from 0.
  std::string name;  ///< What errors call it: its file, or the video and its frame.
};

/// Images one at a time, in the order they were taken.
class ImageReader {
 public:
  virtual ~ImageReader() = default;

  /// The next image; none after the last. Throws corvo::Error where it cannot be read.
  virtual std::optional<TimedImage> Read() = 0;

  /// Leaves out the next image; false after the last.
  virtual bool Skip() = 0;
};

std::unique_ptr<ImageReader> OpenFiles(std::vector<TimedFile> files);

/// A video with the times of its frames, or index / `frame_rate_hz` if that is given. A time that
/// does not lie after the one before (a container without times) is moved to a frame's duration
/// after it. Throws corvo::Error where the file is no video that can be decoded.
std::unique_ptr<ImageReader> OpenVideo(const std::filesystem::path& file,
                                       std::optional<double> frame_rate_hz);

/// A connected camera, with the times since it was opened. Throws corvo::Error where there is no
/// such camera.
std::unique_ptr<ImageReader> OpenCamera(int device);

/// 8-bit gray. Color becomes 0.299 R + 0.587 G + 0.114 B (a JPEG's own luma); of 16 bits the upper
/// eight are kept. Throws corvo::Error where there is no readable image, or a JPEG without its
/// end.
cv::Mat ReadGrayImage(const std::filesystem::path& file);

/// The same for a decoded image of 8 or 16 bits with one, three (BGR) or four (BGRA) channels;
/// `name` starts the message of the corvo::Error for any other.
cv::Mat ToGray(const cv::Mat& image, const std::string& name);

}  // namespace corvo
