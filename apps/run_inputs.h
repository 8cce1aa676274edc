#pragma once

#include <filesystem>
#include <optional>

#include "apps/image_source.h"
#include "apps/run_truth.h"
#include "vo/camera.h"
#include "vo/options.h"

namespace corvo {

/// What the user asked `corvo run` for. Empty paths were not given.
struct RunArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path config;
  std::filesystem::path camera;
  std::filesystem::path truth;     ///< "none" is none, even where the dataset has it.
  std::optional<double> max_dt_s;  ///< Between poses that are compared; none is half a frame.
  std::optional<double> frame_rate_hz;
  std::filesystem::path pictures;         ///< Folder for drawings of the tracked features.
  std::optional<double> metres_per_unit;  ///< Scales what is written; none is 1.
  int threads = 1;
};

/// Everything a run reads but the pictures.
struct RunInputs {
  OdometryOptions options;
  Camera camera;
  ImageSource source;
  RunTruth truth;
};

/// Reads and checks all of it, and that the first picture has the camera's size. Throws
/// corvo::Error.
RunInputs ReadInputs(const RunArguments& arguments);

/// Throws corvo::Error naming both sizes unless the picture has the camera's.
void CheckSize(const cv::Mat& image, const Camera& camera, const std::filesystem::path& file);

}  // namespace corvo
