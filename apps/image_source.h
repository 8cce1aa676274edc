#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vo/camera.h"
#include "vo/conventions.h"

namespace corvo {

struct TimedFile {
  std::filesystem::path file;
  TimeNs time_ns = 0;
};

/// The pictures of a sequence, in the order they were taken, and what its dataset says of them.
struct ImageList {
  std::string layout;                      ///< "folder", "kitti", "euroc" or "tum".
  std::vector<TimedFile> images;           ///< At least one; times ascend; every file exists.
  std::optional<CameraParameters> camera;  ///< Valid; where the dataset ships a calibration.
};

/// Recognises the layout of `input` by its files and lists its pictures. A folder that has no times
/// gets index / frame_rate_hz. Throws corvo::Error naming file, line and value.
ImageList ListImages(const std::filesystem::path& input, double frame_rate_hz);

/// 8-bit grey, colour converted. Throws corvo::Error where there is no readable picture.
cv::Mat ReadGreyImage(const std::filesystem::path& file);

struct TimedImage {
  cv::Mat image;  ///< 8-bit grey.
  TimeNs time_ns = 0;
};

/// Hands out the pictures of a list one at a time, each decoded when it is asked for.
class ImageSource {
 public:
  explicit ImageSource(ImageList list) : list_(std::move(list)) {}

  /// The next picture; none after the last. Throws corvo::Error where it cannot be read.
  std::optional<TimedImage> Next();

  const ImageList& list() const { return list_; }

 private:
  ImageList list_;
  std::size_t next_ = 0;
};

}  // namespace corvo
