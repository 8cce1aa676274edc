// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vo/camera/camera_parameters.h"
#include "vo/core/conventions.h"

namespace corvo {

struct TimedFile {
  std::filesystem::path file;
  TimeNs time_ns = 0;
};

/// The images of a sequence, in the order in which they were taken, and their calibration.
struct ImageList {
  std::string layout;  ///< "folder", "glob", "kitti", "kitti-raw", "euroc", "tum", "tum-mono",
                       ///< "tartanair", "video", "bag", "camera".
  std::vector<TimedFile> images;           ///< In ascending time. Only of image files.
  std::optional<CameraParameters> camera;  ///< The dataset's calibration, if any; valid.
};

/// How images get their times and their camera, and 16-bit ones their gray levels.
struct InputOptions {
  std::optional<double> frame_rate_hz;  ///< Of images without times; replaces times in file names.
  double default_frame_rate_hz = 30;    ///< The same if `frame_rate_hz` is not given.
  std::filesystem::path times;          ///< A file of times that replace all others; see
                                        ///< ReadImageTimes().
  std::optional<int> bits;              ///< Used bits of 16-bit images; found if not given.
  std::string topic;                    ///< The images of a ROS bag; empty for its only topic of
                                        ///< images.
  bool reads_camera = true;             ///< Whether the dataset's calibration is read, which may be
                                        ///< missing or malformed if another camera replaces it.
};

/// Recognizes the layout of a folder by its files, or interprets `input` as a file name pattern,
/// and lists the images, which need not exist. Images without times get those in their names (see
/// TimesInNames()), or else index / frame rate. Throws corvo::Error with file, line and value if
/// something is missing or malformed, or if there are no images.
ImageList ListImages(const std::filesystem::path& input, const InputOptions& options = {});

}  // namespace corvo
