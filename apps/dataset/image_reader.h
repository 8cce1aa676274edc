// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/codecs/codecs.h"
#include "apps/dataset/gray_levels.h"
#include "apps/dataset/image_list.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"

namespace corvo {

struct TimedImage {
  cv::Mat image;  ///< 8-bit gray; empty if it is missing.
  cv::Mat mask;   ///< Empty, or of the image's size: features are detected only where nonzero.
  TimeNs time_ns = 0;
  int index = 0;     ///< Index in the whole sequence, from 0.
  std::string name;  ///< Name for error messages: its file, or the video and frame number.
  Reason missing = Reason::kNone;  ///< Why the image is missing; kNone if it is not.
  std::string error = {};          ///< The error that made it so.
  cv::Mat color = {};              ///< The decoded image, 8-bit BGR, if it came in color for free.
};

/// The frames of a video file or bag, counted while it is read.
struct VideoFrames {
  int num_promised = 0;  ///< According to the container, which may estimate; 0 if it does not say.
  int num_read = 0;
  int num_damaged = 0;      ///< Frames before others that cannot be decoded; they are left out.
  bool is_cut_off = false;  ///< Whether it has ended too early, or with frames missing by errors.
};

/// Reads images one at a time, in the order in which they were taken.
class ImageReader {
 public:
  virtual ~ImageReader() = default;

  /// Returns the next image, or std::nullopt after the last. Throws corvo::Error if it cannot be
  /// read; the next call then returns the image after it.
  virtual std::optional<TimedImage> Read() = 0;

  /// Skips the next image. Returns false after the last.
  virtual bool Skip() = 0;

  /// From another thread, ends the wait for a connected camera: Read() and Skip() then find the
  /// end.
  virtual void Cancel() {}

  /// Returns std::nullopt unless this is a video file or bag.
  virtual std::optional<VideoFrames> video_frames() const { return std::nullopt; }

  /// Returns how 16-bit images became 8-bit ones, or std::nullopt if none was read.
  virtual std::optional<GrayLevels> gray_levels() const { return std::nullopt; }
};

/// Opens image files. Of 16-bit images, `bits` (8 to 16) are used, of which the upper eight are
/// kept; without it, the gray levels of images all over the sequence decide, see GrayHistogram.
/// Throws corvo::Error if `bits` is out of range.
std::unique_ptr<ImageReader> OpenFiles(std::vector<TimedFile> files, std::optional<int> bits);

/// Opens a video. Its timestamps are those of the container, or index / `frame_rate_hz` if that is
/// given. A timestamp that is not later than the previous one (a container without timestamps) is
/// replaced by the previous one plus a frame's duration. Frames that cannot be decoded are left
/// out. Images are turned upright as the container says. Throws corvo::Error if the file is not a
/// video that can be decoded.
std::unique_ptr<ImageReader> OpenVideo(const std::filesystem::path& file,
                                       std::optional<double> frame_rate_hz);

/// Opens a connected camera. Timestamps count from its opening. A camera that stops delivering
/// images is opened again, until it is back or ImageReader::Cancel() is called. Throws corvo::Error
/// if there is no such camera.
std::unique_ptr<ImageReader> OpenCamera(int device);

/// Like OpenCamera(), but for a camera that `open` opens, or returns null. Messages call it `name`.
std::unique_ptr<ImageReader> OpenCamera(std::function<std::unique_ptr<VideoInput>()> open,
                                        const std::string& name);

/// Reads an image as 8- or 16-bit gray, as it is stored. Color is converted to 0.299 R + 0.587 G +
/// 0.114 B (the luma of JPEG). The orientation of EXIF is ignored, with a warning for the first
/// image that has one. Throws corvo::Error if the file is not
/// a readable image, is a truncated or damaged JPEG or PNG, is larger than kMaxImageBytes, or has
/// more than kMaxImagePixels according to its header (of PNG, JPEG, BMP, PNM, TIFF and WebP).
cv::Mat ReadStoredGray(const std::filesystem::path& file);

/// Like ReadStoredGray(), but of the bytes of an image file, which messages call `name`.
cv::Mat DecodeStoredGray(const std::string& bytes, const std::string& name);

/// Like ReadStoredGray(), but as 8-bit gray.
cv::Mat ReadGrayImage(const std::filesystem::path& file, const GrayLevels& levels = GrayLevels());

/// Like ReadStoredGray(), but as 8- or 16-bit BGR.
cv::Mat ReadStoredColor(const std::filesystem::path& file);

/// Like ReadStoredColor(), but as 8-bit BGR.
cv::Mat ReadColorImage(const std::filesystem::path& file, const GrayLevels& levels);

/// Converts a decoded image to 8-bit gray, of 16 bits the upper eight. It must have 8 or 16 bits
/// and one, three (BGR) or four (BGRA) channels; for any other image, throws a corvo::Error whose
/// message starts with `name`.
cv::Mat ToGray(const cv::Mat& image, const std::string& name);

}  // namespace corvo
