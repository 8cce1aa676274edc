// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/run_truth.h"
#include "apps/system/interruption.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"

namespace corvo {

/// The arguments of `corvo run`. An empty path was not given.
struct RunArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path config;
  std::filesystem::path camera;
  /// "auto" to calibrate the camera from the images, a focal length in px, or empty.
  std::string focal;
  std::optional<double> fov_deg;   ///< Horizontal field of view.
  std::filesystem::path truth;     ///< "none" disables the dataset's ground truth, too.
  std::optional<double> max_dt_s;  ///< Maximum time difference of compared poses; see HalfFrame().
  std::filesystem::path mask;
  InputOptions stored;                    ///< What is given of the times and levels of images.
  std::filesystem::path drawings;         ///< Folder or film for drawings of the tracked features.
  std::filesystem::path plot;             ///< File for a plot beside that of the results.
  std::optional<double> meters_per_unit;  ///< Scale factor of the written results; default 1.
  std::optional<double> camera_height_m;  ///< Height of the camera above the ground.
  std::vector<std::string> known_distances;  ///< See ParseKnownDistance().
  std::vector<std::string> known_sizes;      ///< See ParseKnownSize().
  Selection selection;
  std::string resize;  ///< "WxH" or a factor; empty for the original size.
  int threads = 1;
  bool realtime = false;  ///< Whether images are taken when a camera would deliver them.
  bool strict = false;    ///< Whether an image that cannot be read or has another size is an error.
  bool force = false;     ///< Whether files that are not corvo's are replaced.
  bool json = false;      ///< Print summary.json instead of a text.
  bool keyframe_features = false;  ///< Write the features of the keyframes.
  bool refine = false;             ///< Refine the whole sequence after the last frame.
  std::string calibration;  ///< "estimate" or "fixed"; if empty, calibration.enabled decides.

  /// Returns whether the results are to be in meters.
  bool IsMetric() const {
    return meters_per_unit || camera_height_m || !known_distances.empty() || !known_sizes.empty();
  }
};

/// The inputs of a run.
struct RunInputs {
  OdometryOptions options;
  CameraPrior camera;  ///< Camera of the images as `source` returns them, after resizing.
  ImageSource source;
  RunTruth truth;
  std::vector<std::string> warnings;  ///< Of values of the given camera that are unusual.
};

/// Adds --start, --every and --count.
void AddSelectionOptions(CLI::App& command, Selection& selection);

/// Adds --fps, --times, --bits and --topic: what the images do not say.
void AddStoredImageOptions(CLI::App& command, InputOptions& options);

/// Adds INPUT and the options that select the images and their camera.
void AddInputOptions(CLI::App& command, RunArguments& arguments);

/// Opens the images that the arguments select, with their masks, resized as these say. The required
/// size is that of the first readable one. Throws corvo::Error as OpenImages(), if no image can be
/// read, and for a live camera, whose images are not stored.
ImageSource OpenPreparedImages(const RunArguments& arguments);

/// Reads and checks all inputs, including that the first image has the camera's size and that a
/// given camera is plausible (see CheckCamera()). Calibrates
/// the camera from the images if requested. Throws corvo::Error, and Interrupted if an interruption
/// was requested.
RunInputs ReadInputs(const RunArguments& arguments, const Interruption& interruption);

/// Returns the size given by "WxH", or `size` times the given factor, rounded. Throws corvo::Error
/// for any other text, for a size outside 16 to 100000 px, and for more than kMaxImagePixels.
cv::Size ParseResize(const std::string& text, const cv::Size& size);

}  // namespace corvo
