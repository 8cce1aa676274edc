// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/App.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/interruption.h"
#include "apps/run/run_truth.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"

namespace corvo {

/// What the user asked `corvo run` for. Empty paths were not given.
struct RunArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path config;
  std::filesystem::path camera;
  std::string focal;               ///< "auto": the camera is found from the images.
  std::filesystem::path truth;     ///< "none" is none, even where the dataset has it.
  std::optional<double> max_dt_s;  ///< Between poses that are compared; none is half a frame.
  std::filesystem::path mask;
  std::optional<double> frame_rate_hz;
  std::filesystem::path drawings;         ///< Folder for drawings of the tracked features.
  std::optional<double> meters_per_unit;  ///< Scales what is written; none is 1.
  Selection selection;
  std::string resize;  ///< "WxH" or a factor; empty: not asked for.
  int threads = 1;
  bool refine = false;      ///< After the last frame.
  std::string calibration;  ///< "estimate" or "fixed"; empty: as the options say.
};

/// Everything a run reads but the images.
struct RunInputs {
  OdometryOptions options;
  CameraPrior
      camera;  ///< Of the images as `source` hands them out: resized, if that was asked for.
  ImageSource source;
  RunTruth truth;
};

/// Adds --start, --every and --count.
void AddSelectionOptions(CLI::App& command, Selection& selection);

/// Adds INPUT and the options that say which images are read, and how.
void AddInputOptions(CLI::App& command, RunArguments& arguments);

/// Reads and checks all of it, and that the first image has the camera's size; finds the camera
/// where that is asked for. Throws corvo::Error and Interrupted.
RunInputs ReadInputs(const RunArguments& arguments, const Interruption& interruption);

/// The size of "WxH", or of `size` times a factor, rounded. Throws corvo::Error on any other text,
/// and on a size outside 16 to 100000 px.
cv::Size ParseResize(const std::string& text, const cv::Size& size);

}  // namespace corvo
