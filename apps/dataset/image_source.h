// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/dataset/image_list.h"
#include "apps/dataset/image_reader.h"
#include "apps/dataset/mask_source.h"
#include "vo/camera/camera.h"
#include "vo/core/conventions.h"

namespace corvo {

/// A selection of the images of a sequence.
struct Selection {
  int start = 0;             ///< Index of the first image.
  int every = 1;             ///< Stride: every n-th image is used.
  std::optional<int> count;  ///< Maximum number of images.
};

/// The preparation of every image.
struct Preparation {
  cv::Size size;       ///< The required size of the images.
  cv::Size resize_to;  ///< The size after resizing; pixels are averaged if it is smaller.
  MaskSource mask_source;
};

/// Returns the images of a sequence one at a time. Each image is decoded on request. An image that
/// cannot be read or has another size is returned as missing.
class ImageSource {
 public:
  /// `bits` is the number of used bits of 16-bit images, found from the images if not given.
  explicit ImageSource(ImageList list, const Selection& selection = {},
                       std::optional<int> bits = std::nullopt);
  ImageSource(ImageList list, std::unique_ptr<ImageReader> reader, const Selection& selection);

  /// From now on, throws corvo::Error for an image that would be missing.
  void RequireAll() { requires_all_ = true; }

  /// Returns the first readable image as it is read, without consuming it. Throws corvo::Error if
  /// there is none.
  const TimedImage& First();

  /// Sets the preparation of all images that Next() returns. Throws corvo::Error with both sizes if
  /// none of the first images has the required size.
  void Prepare(Preparation preparation);

  /// Returns the next image, or std::nullopt after the last. It is missing if it cannot be read or
  /// does not have the size required by Prepare().
  std::optional<TimedImage> Next();

  /// Skips the next image without decoding it. Returns false after the last.
  bool Skip();

  /// From another thread, ends a call of Next() that waits for a connected camera, and all later
  /// ones.
  void Cancel() { reader_->Cancel(); }

  /// Returns the number of selected images (an upper bound unless they are files), or std::nullopt
  /// if it is unknown.
  std::optional<int> size() const;
  /// Returns size(), or the number of selected frames that a video or bag promises, or
  /// std::nullopt.
  std::optional<int> expected_size() const;
  /// Returns whether this is a connected camera, whose sequence ends only when the user stops it.
  bool is_live() const { return list_.layout == "camera"; }
  const ImageList& list() const { return list_; }
  /// Returns std::nullopt unless this is a video file or bag.
  std::optional<VideoFrames> video_frames() const { return reader_->video_frames(); }
  /// Returns how 16-bit images became 8-bit ones, or std::nullopt if none was read.
  std::optional<GrayLevels> gray_levels() const { return reader_->gray_levels(); }

 private:
  std::optional<TimedImage> ReadNext();
  /// Reads the next image in addition to those read ahead. Returns false after the last.
  bool ReadAhead();
  /// Advances to the next selected image. Returns false if there is none.
  bool Advance();

  ImageList list_;
  std::unique_ptr<ImageReader> reader_;
  Selection selection_;
  std::optional<Preparation> preparation_;
  std::deque<TimedImage> ahead_;  ///< Read, but not yet returned by Next().
  int num_read_ = 0;              ///< Number of selected images that were read or skipped.
  int num_passed_ = 0;            ///< The same, with those that are not selected.
  bool requires_all_ = false;
};

/// Shrinks an image by averaging, or enlarges it by linear interpolation.
cv::Mat ResizeImage(const cv::Mat& image, const cv::Size& size);

/// Returns whether the input is a connected camera: "0" or "camera:0".
bool IsLiveInput(const std::string& input);

/// Opens a folder or pattern of images, a video, a ROS bag, or a camera. The frame rate of
/// `options`, if given, also replaces the timestamps of a video or bag. Throws corvo::Error as
/// ListImages(), for a file of times that is given for anything but image files, and for a topic of
/// anything but a bag.
ImageSource OpenImages(const std::string& input, const InputOptions& options,
                       const Selection& selection);

}  // namespace corvo
