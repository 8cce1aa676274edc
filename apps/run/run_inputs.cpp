// SPDX-License-Identifier: MIT
#include "apps/run/run_inputs.h"

#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/image_header.h"
#include "apps/dataset/named_camera.h"
#include "apps/dataset/shipped_cameras.h"
#include "apps/run/camera_check.h"
#include "apps/run/camera_start.h"
#include "apps/run/number_option.h"
#include "apps/run/sequence_stream.h"
#include "apps/run/stated_focal.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

/// Returns the camera given by --camera, if any. Logs which one is used if the file has several.
std::optional<StatedCamera> ReadGivenCamera(const RunArguments& arguments) {
  if (arguments.camera.empty()) return std::nullopt;
  CalibrationFile file = ReadNamedCamera(arguments.camera);
  const bool is_chosen = arguments.camera.string().ends_with(":" + file.name);
  if (file.names.size() > 1 && !is_chosen) {
    spdlog::info("{0}: the first of {1} cameras, {2}, is used; {0}:NAME selects another",
                 arguments.camera.string(), file.names.size(), file.name);
  }
  return std::move(file.camera);
}

/// Returns whether an option replaces the calibration of the dataset.
bool ReplacesCamera(const RunArguments& arguments) {
  return !arguments.camera.empty() || !arguments.focal.empty() || arguments.fov_deg;
}

InputOptions OptionsOf(const RunArguments& arguments, const std::optional<StatedCamera>& camera) {
  InputOptions options = arguments.stored;
  options.reads_camera = !ReplacesCamera(arguments);
  if (camera && camera->frame_rate_hz) options.default_frame_rate_hz = *camera->frame_rate_hz;
  return options;
}

[[noreturn]] void ThrowNoCamera(const RunArguments& arguments, const cv::Size& size) {
  std::string message =
      fmt::format("{}: ships no calibration; give --camera FILE, --fov DEGREES, or --focal auto",
                  arguments.input.string());
  const std::vector<std::string> cameras = ShippedCameraNames(size.width, size.height);
  if (!cameras.empty()) {
    message += fmt::format("; shipped cameras of {} x {} px, for --camera: {}", size.width,
                           size.height, fmt::join(cameras, ", "));
  }
  throw Error(message);
}

std::vector<TimeNs> FrameTimes(const ImageList& list) {
  std::vector<TimeNs> times;
  for (const TimedFile& image : list.images) times.push_back(image.time_ns);
  return times;
}

/// Reads the ground truth. A video or a live camera needs ground truth with timestamps, because its
/// own are not known in advance.
RunTruth ReadTruth(const RunArguments& arguments, const ImageList& list) {
  if (!list.images.empty()) {
    return ReadRunTruth(arguments.truth, arguments.input, FrameTimes(list));
  }
  if (arguments.truth.empty() || arguments.truth == "none") return {};
  const PoseFile truth = ReadTruthFile(arguments.truth);
  if (truth.has_times()) return {arguments.truth, truth.poses()};
  throw Error(
      fmt::format("{}: KITTI format has no timestamps; a {} needs ground truth in TUM format",
                  arguments.truth.string(), list.layout));
}

OdometryOptions ReadRunOptions(const RunArguments& arguments) {
  OdometryOptions options;
  if (!arguments.config.empty()) options = ReadOptions(arguments.config);
  if (!arguments.calibration.empty()) {
    options.calibration.enabled = arguments.calibration == "estimate";
  }
  return options;
}

void CheckFocal(const RunArguments& arguments) {
  if (arguments.focal.empty()) return;
  CheckFocalText(arguments.focal);
  if (arguments.focal != kAutoFocal || !IsLiveInput(arguments.input.string())) return;
  throw Error(
      fmt::format("--focal auto: {} is a live camera, which cannot be read twice; give --camera "
                  "FILE, --fov DEGREES, or a recording",
                  arguments.input.string()));
}

MaskSource OpenMasks(const RunArguments& arguments, const TimedImage& first) {
  return arguments.mask.empty() ? MaskSource() : MaskSource(arguments.mask, first);
}

/// Returns the size of the images of a run, whose size as they are stored is given.
cv::Size SizeOf(const RunArguments& arguments, const cv::Size& stored) {
  return arguments.resize.empty() ? stored : ParseResize(arguments.resize, stored);
}

/// Returns the given camera, whose size is that of the images if its file states none, or the one
/// calibrated from the images or stated by its focal length if requested, or else the dataset's.
CameraPrior ReadCamera(const RunArguments& arguments, const std::optional<StatedCamera>& given,
                       const OdometryOptions& options, const Interruption& interruption,
                       ImageSource& source) {
  if (given) {
    const cv::Size size = source.First().image.size();
    return given->ForImages(size.width, size.height).Prior(options.calibration);
  }
  if (arguments.focal == kAutoFocal) {
    SelfCalibrationOptions calibration;
    calibration.odometry = options;
    calibration.threads = arguments.threads;
    RunArguments original = arguments;
    original.resize.clear();
    return FindSequenceCamera(ToStreamOpener([&] { return OpenPreparedImages(original); }),
                              calibration, interruption);
  }
  const cv::Size size = source.First().image.size();
  if (const auto focal_px = StatedFocal(arguments.focal, arguments.fov_deg, size.width)) {
    return StatedFocalPrior(*focal_px, size);
  }
  if (!source.list().camera) ThrowNoCamera(arguments, size);
  return MakePrior(*source.list().camera, options.calibration);
}

void AddFocalOptions(CLI::App& command, CLI::Option* camera, RunArguments& arguments) {
  CLI::Option* const focal =
      command
          .add_option("--focal", arguments.focal,
                      "auto: calibrate the camera from the images, by a focal length search and "
                      "passes over at most 500 images; or the approximate focal length of the "
                      "images (before --resize), px; overrides the dataset's calibration")
          ->type_name("auto|PX")
          ->excludes(camera);
  command
      .add_option("--fov", arguments.fov_deg,
                  "approximate horizontal field of view, degrees; overrides the dataset's "
                  "calibration")
      ->check(NumberRange(kMinStatedFovDeg, kMaxStatedFovDeg))
      ->excludes(camera)
      ->excludes(focal);
}

/// Returns the warnings about the camera if it was given as numbers: by a file or by the dataset.
std::vector<std::string> CheckGivenCamera(const RunArguments& arguments,
                                          const CameraParameters& camera) {
  if (!arguments.focal.empty() || arguments.fov_deg) return {};
  return CheckCamera(arguments.camera.empty() ? arguments.input : arguments.camera, camera);
}

/// Tells what the inputs were taken for, for --verbose.
void LogInputs(const RunArguments& arguments, const RunInputs& inputs) {
  const ImageList& list = inputs.source.list();
  const std::optional<int> size = inputs.source.expected_size();
  spdlog::debug("{}: layout {}, {} images to process", arguments.input.string(), list.layout,
                size ? std::to_string(*size) : "an unknown number of");
  const CameraParameters& camera = inputs.camera.given;
  spdlog::debug("camera: {}, {} x {} px, fx {:.2f}, fy {:.2f}, cx {:.2f}, cy {:.2f}",
                ToString(camera.model), camera.width, camera.height, camera.fx, camera.fy,
                camera.cx, camera.cy);
  spdlog::debug("ground truth: {} poses{}", inputs.truth.poses.size(),
                inputs.truth.file.empty() ? "" : " of " + inputs.truth.file.string());
}

}  // namespace

cv::Size ParseResize(const std::string& text, const cv::Size& size) {
  const std::string where = fmt::format("--resize '{}': ", text);
  const std::size_t cross = text.find('x');
  const bool is_factor = cross == std::string::npos;
  const double width =
      is_factor ? ParseNumber(text, where) * size.width : ParseNumber(text.substr(0, cross), where);
  const double height = is_factor ? ParseNumber(text, where) * size.height
                                  : ParseNumber(text.substr(cross + 1), where);
  CheckRange(where + "width", width, 16.0, 1e5);
  CheckRange(where + "height", height, 16.0, 1e5);
  CheckRange(where + "number of pixels", static_cast<std::int64_t>(width * height),
             std::int64_t{16 * 16}, kMaxImagePixels);
  return {static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height))};
}

void AddStoredImageOptions(CLI::App& command, InputOptions& options) {
  command
      .add_option("--fps", options.frame_rate_hz,
                  "frame rate of images without timestamps, Hz; overrides a video's timestamps "
                  "and those in file names")
      ->check(NumberRange(1e-3, 1e6));
  command.add_option("--times", options.times,
                     "file with the time of each image, one per line, alone or beside its name, in "
                     "s, ms, us or ns; overrides all other timestamps");
  command
      .add_option("--bits", options.bits,
                  "number of used bits of 16-bit images; overrides what their gray levels say")
      ->check(CLI::Range(8, 16));
  command.add_option("--topic", options.topic,
                     "topic of the images in a ROS bag; needed if it has several");
}

void AddSelectionOptions(CLI::App& command, Selection& selection) {
  command.add_option("--start", selection.start, "index of the first image, starting at 0")
      ->check(CLI::Range(0, 1000000000));
  command.add_option("--every", selection.every, "use only every n-th image")
      ->check(CLI::Range(1, 1000000000));
  command.add_option("--count", selection.count, "maximum number of images")
      ->check(CLI::Range(1, 1000000000));
}

void AddInputOptions(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("INPUT", arguments.input,
                  "image folder, quoted file pattern, KITTI, KITTI raw, EuRoC, TUM-VI, TUM RGB-D, "
                  "TUM-mono or TartanAir sequence, video, ROS bag, or camera number")
      ->required();
  CLI::Option* const camera = command.add_option(
      "--camera", arguments.camera,
      "calibration file of corvo, OpenCV, Kalibr, ROS, ORB-SLAM, COLMAP, KITTI, "
      "DSO or others, FILE:NAME for one of several cameras in it, or the name of "
      "a shipped camera (tum_fr1); overrides the dataset's calibration");
  AddFocalOptions(command, camera, arguments);
  AddStoredImageOptions(command, arguments.stored);
  command.add_flag("--strict", arguments.strict,
                   "make an image that cannot be read or has another size an error; otherwise its "
                   "frame has no pose and tracking goes on");
  AddSelectionOptions(command, arguments.selection);
  command.add_option("--resize", arguments.resize,
                     "new image size WxH in px, or a factor; the camera is scaled accordingly");
  command.add_option(
      "--mask", arguments.mask,
      "mask image, or folder with one mask per image; no features are detected where "
      "a mask is 0");
}

ImageSource OpenPreparedImages(const RunArguments& arguments) {
  if (IsLiveInput(arguments.input.string())) {
    throw Error(
        fmt::format("{}: the images of a live camera are not stored", arguments.input.string()));
  }
  ImageSource images =
      OpenImages(arguments.input.string(), OptionsOf(arguments, {}), arguments.selection);
  if (arguments.strict) images.RequireAll();
  const TimedImage& first = images.First();
  const cv::Size size = first.image.size();
  images.Prepare({size, SizeOf(arguments, size), OpenMasks(arguments, first)});
  return images;
}

RunInputs ReadInputs(const RunArguments& arguments, const Interruption& interruption) {
  const OdometryOptions options = ReadRunOptions(arguments);
  const std::optional<StatedCamera> given = ReadGivenCamera(arguments);
  CheckFocal(arguments);
  ImageSource source =
      OpenImages(arguments.input.string(), OptionsOf(arguments, given), arguments.selection);
  if (arguments.strict) source.RequireAll();
  const TimedImage& first = source.First();
  const CameraPrior camera = ReadCamera(arguments, given, options, interruption, source);
  std::vector<std::string> warnings = CheckGivenCamera(arguments, camera.given);
  const cv::Size size(camera.given.width, camera.given.height);
  const cv::Size resized = SizeOf(arguments, size);
  source.Prepare({size, resized, OpenMasks(arguments, first)});
  RunTruth truth = ReadTruth(arguments, source.list());
  RunInputs inputs{options, camera.Resized(resized.width, resized.height), std::move(source),
                   std::move(truth), std::move(warnings)};
  LogInputs(arguments, inputs);
  return inputs;
}

}  // namespace corvo
