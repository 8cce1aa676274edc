// SPDX-License-Identifier: MIT
#include "apps/run/run_inputs.h"

#include <cmath>

#include <fmt/format.h>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/shipped_cameras.h"
#include "apps/dataset/tum_mono_sequence.h"
#include "apps/run/camera_start.h"
#include "apps/run/sequence_stream.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

constexpr double kDefaultFrameRateHz = 30.0;

/// The camera the user named, if any: a camera file, or the camera.txt of a TUM-mono sequence.
std::optional<CameraFile> ReadNamedCamera(const RunArguments& arguments) {
  if (arguments.camera.empty()) return std::nullopt;
  if (arguments.camera.extension() != ".txt") return ReadCameraFile(arguments.camera);
  return CameraFile{Camera(ReadTumMonoCamera(arguments.camera)), {}, "", {}};
}

double DefaultFrameRate(const std::optional<CameraFile>& file) {
  return file && file->frame_rate_hz ? *file->frame_rate_hz : kDefaultFrameRateHz;
}

[[noreturn]] void ThrowNoCamera(const RunArguments& arguments, const cv::Size& size) {
  std::string message = fmt::format("{}: ships no calibration; give --camera FILE, or --focal auto",
                                    arguments.input.string());
  const std::vector<std::filesystem::path> cameras = FindShippedCameras(size.width, size.height);
  if (!cameras.empty()) {
    message += fmt::format("; for {} x {} px there are", size.width, size.height);
    for (const std::filesystem::path& file : cameras) {
      message += fmt::format(" {}", file.string());
    }
  }
  throw Error(message);
}

std::vector<TimeNs> FrameTimes(const ImageList& list) {
  std::vector<TimeNs> times;
  for (const TimedFile& image : list.images) times.push_back(image.time_ns);
  return times;
}

/// The times of a video or of a camera are not known beforehand.
RunTruth ReadTruth(const RunArguments& arguments, const ImageList& list) {
  if (!list.images.empty()) {
    return ReadRunTruth(arguments.truth, arguments.input, FrameTimes(list));
  }
  if (arguments.truth.empty() || arguments.truth == "none") return {};
  const PoseFile truth = ReadTruthFile(arguments.truth);
  if (truth.has_times()) return {arguments.truth, truth.poses()};
  throw Error(fmt::format("{}: KITTI format has no times; a {} needs a truth in TUM format",
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
  if (arguments.focal.empty() || !IsLiveInput(arguments.input.string())) return;
  throw Error(
      fmt::format("--focal auto: {} is a live camera, whose images come but once; give --camera "
                  "FILE, or a recording",
                  arguments.input.string()));
}

MaskSource OpenMasks(const RunArguments& arguments, const TimedImage& first) {
  return arguments.mask.empty() ? MaskSource() : MaskSource(arguments.mask, first);
}

/// The images of a run, of the size that they have.
ImageSource OpenPreparedImages(const RunArguments& arguments) {
  ImageSource images = OpenImages(arguments.input.string(), arguments.frame_rate_hz,
                                  kDefaultFrameRateHz, arguments.selection);
  const TimedImage& first = images.First();
  const cv::Size size = first.image.size();
  images.Prepare({size, size, OpenMasks(arguments, first)});
  return images;
}

/// Named, found or the dataset's own.
CameraPrior ReadCamera(const RunArguments& arguments, const std::optional<CameraFile>& named,
                       const OdometryOptions& options, const Interruption& interruption,
                       ImageSource& source) {
  if (named) return named->Prior(options.calibration);
  if (!arguments.focal.empty()) {
    SelfCalibrationOptions calibration;
    calibration.odometry = options;
    calibration.threads = arguments.threads;
    return FindSequenceCamera(ToStreamOpener([&] { return OpenPreparedImages(arguments); }),
                              calibration, interruption);
  }
  if (!source.list().camera) ThrowNoCamera(arguments, source.First().image.size());
  return MakePrior(*source.list().camera, options.calibration);
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
  return {static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height))};
}

void AddSelectionOptions(CLI::App& command, Selection& selection) {
  command.add_option("--start", selection.start, "index of the first image, from 0")
      ->check(CLI::Range(0, 1000000000));
  command.add_option("--every", selection.every, "of so many images one is read")
      ->check(CLI::Range(1, 1000000000));
  command.add_option("--count", selection.count, "images to read, at most")
      ->check(CLI::Range(1, 1000000000));
}

void AddInputOptions(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("INPUT", arguments.input,
                  "folder of images, quoted pattern of images, KITTI, EuRoC, TUM-VI, TUM RGB-D or "
                  "TUM-mono sequence, video, or number of a camera")
      ->required();
  CLI::Option* const camera =
      command.add_option("--camera", arguments.camera,
                         "camera file, or a TUM-mono camera.txt; instead of the dataset's own");
  command
      .add_option("--focal", arguments.focal,
                  "auto: the camera is found in the images: a search for the focal length, and a "
                  "first pass through 500 of them at most; instead of the dataset's camera")
      ->check(CLI::IsMember({"auto"}))
      ->excludes(camera);
  command
      .add_option("--fps", arguments.frame_rate_hz,
                  "frames a second of images without times, or instead of a video's times")
      ->check(CLI::Range(1e-3, 1e6));
  AddSelectionOptions(command, arguments.selection);
  command.add_option("--resize", arguments.resize,
                     "WxH in px or a factor; the camera is scaled with the images");
  command.add_option("--mask", arguments.mask,
                     "image, or folder with one for each: no features where it is 0");
}

RunInputs ReadInputs(const RunArguments& arguments, const Interruption& interruption) {
  const OdometryOptions options = ReadRunOptions(arguments);
  const std::optional<CameraFile> named = ReadNamedCamera(arguments);
  CheckFocal(arguments);
  ImageSource source = OpenImages(arguments.input.string(), arguments.frame_rate_hz,
                                  DefaultFrameRate(named), arguments.selection);
  const TimedImage& first = source.First();
  const CameraPrior camera = ReadCamera(arguments, named, options, interruption, source);
  const cv::Size size(camera.given.width, camera.given.height);
  const cv::Size resized = arguments.resize.empty() ? size : ParseResize(arguments.resize, size);
  source.Prepare({size, resized, OpenMasks(arguments, first)});
  RunTruth truth = ReadTruth(arguments, source.list());
  return {options, camera.Resized(resized.width, resized.height), std::move(source),
          std::move(truth)};
}

}  // namespace corvo
