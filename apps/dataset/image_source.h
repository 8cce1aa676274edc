// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/dataset/image_reader.h"
#include "apps/dataset/mask_source.h"
#include "vo/camera/camera.h"
#include "vo/core/conventions.h"

namespace corvo {

/// The images of a sequence, in the order in which they were taken, and their calibration.
struct ImageList {
  std::string
      layout;  ///< "folder", "glob", "kitti", "euroc", "tum", "tum-mono", "video", "camera".
  std::vector<TimedFile> images;           ///< In ascending time. Empty for a video or camera.
  std::optional<CameraParameters> camera;  ///< The dataset's calibration, if any; valid.
};

/// A selection of the images of a sequence.
struct Selection {
  int start = 0;             ///< Index of the first image.
  int every = 1;             ///< Stride: every n-th image is used.
  std::optional<int> count;  ///< Maximum number of images.
};

/// Recognizes the layout of a folder by its files, or interprets `input` as a file name pattern,
/// and lists the images. Images without timestamps get index / frame_rate_hz. Throws corvo::Error
/// with file, line and value if something is missing or malformed, or if a selected image is
/// missing or there are no images.
ImageList ListImages(const std::filesystem::path& input, double frame_rate_hz,
                     const Selection& selection = {});

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
  explicit ImageSource(ImageList list, const Selection& selection = {});
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

  /// Returns the number of selected images (an upper bound for a video or camera), or std::nullopt
  /// if it is unknown.
  std::optional<int> size() const;
  /// Returns whether this is a connected camera, whose sequence ends only when the user stops it.
  bool is_live() const { return list_.layout == "camera"; }
  const ImageList& list() const { return list_; }
  /// Returns std::nullopt unless this is a video file.
  std::optional<VideoFrames> video_frames() const { return reader_->video_frames(); }

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

/// Returns whether the input is a connected camera: "0" or "camera:0".
bool IsLiveInput(const std::string& input);

/// Opens a folder or pattern of images, a video, or a camera. `frame_rate_hz`, if given, determines
/// the timestamps of images without timestamps and of videos; otherwise images without timestamps
/// get `default_frame_rate_hz`.
ImageSource OpenImages(const std::string& input, std::optional<double> frame_rate_hz,
                       double default_frame_rate_hz, const Selection& selection);

}  // namespace corvo
