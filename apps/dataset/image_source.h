// SPDX-License-Identifier: MIT
#pragma once

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

/// The images of a sequence, in the order they were taken, and what its dataset says of them.
struct ImageList {
  std::string
      layout;  ///< "folder", "glob", "kitti", "euroc", "tum", "tum-mono", "video", "camera".
  std::vector<TimedFile> images;           ///< Times ascend; every file exists. None of a video.
  std::optional<CameraParameters> camera;  ///< Valid; where the dataset ships a calibration.
};

/// Recognizes the layout of a folder by its files, or takes `input` for a pattern of file names,
/// and lists the images: at least one. Where there are no times, they are index / frame_rate_hz.
/// Throws corvo::Error naming file, line and value.
ImageList ListImages(const std::filesystem::path& input, double frame_rate_hz);

/// Which images of a sequence are used.
struct Selection {
  int start = 0;             ///< Index of the first.
  int every = 1;             ///< Of so many images one is used.
  std::optional<int> count;  ///< At most so many are used.
};

/// What is done with every image.
struct Preparation {
  cv::Size size;       ///< That it must have.
  cv::Size resize_to;  ///< Pixels are averaged where that is smaller.
  MaskSource mask_source;
};

/// Hands out the images of a sequence one at a time, each decoded when it is asked for.
class ImageSource {
 public:
  explicit ImageSource(ImageList list, const Selection& selection = {});
  ImageSource(ImageList list, std::unique_ptr<ImageReader> reader, const Selection& selection);

  /// The first image as it is read, which Next() hands out too. Throws corvo::Error if there is
  /// none.
  const TimedImage& First();

  /// From now on images are handed out prepared. Throws corvo::Error where the first has another
  /// size than it must have, naming both.
  void Prepare(Preparation preparation);

  /// The next image; none after the last. Throws corvo::Error where it cannot be read, or is not
  /// of the size that Prepare() was told.
  std::optional<TimedImage> Next();

  /// Leaves out the next image, undecoded; false after the last.
  bool Skip();

  /// How many images there are; none where only their end will tell.
  std::optional<int> size() const;
  /// A connected camera: its sequence has no end but the user's.
  bool is_live() const { return list_.layout == "camera"; }
  const ImageList& list() const { return list_; }

 private:
  std::optional<TimedImage> ReadNext();
  /// To the next selected image; false where there is none.
  bool Advance();

  ImageList list_;
  std::unique_ptr<ImageReader> reader_;
  Selection selection_;
  std::optional<Preparation> preparation_;
  std::optional<TimedImage> first_;  ///< Read, but not handed out yet.
  int num_read_ = 0;
};

/// Whether that is a connected camera: "0" or "camera:0".
bool IsLiveInput(const std::string& input);

/// Opens what the user named: a folder or pattern of images, a video, or a camera.
/// `frame_rate_hz`, if given, makes the times of images that have none and of videos; else
/// images come at `default_frame_rate_hz`.
ImageSource OpenImages(const std::string& input, std::optional<double> frame_rate_hz,
                       double default_frame_rate_hz, const Selection& selection);

}  // namespace corvo
