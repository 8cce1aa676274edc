#include "apps/run_inputs.h"

#include <fmt/format.h>

#include "apps/shipped_cameras.h"
#include "orb/error.h"
#include "vo/config.h"

namespace corvo {
namespace {

constexpr double kDefaultFrameRateHz = 30.0;

/// The camera the user named, if any.
std::optional<CameraFile> ReadNamedCamera(const RunArguments& arguments) {
  if (arguments.camera.empty()) return std::nullopt;
  return ReadCameraFile(arguments.camera);
}

double FrameRate(const RunArguments& arguments, const std::optional<CameraFile>& file) {
  if (arguments.frame_rate_hz) return *arguments.frame_rate_hz;
  return file && file->frame_rate_hz ? *file->frame_rate_hz : kDefaultFrameRateHz;
}

[[noreturn]] void ThrowNoCamera(const RunArguments& arguments, const cv::Size& size) {
  std::string message =
      fmt::format("{}: ships no calibration; give --camera FILE", arguments.input.string());
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

}  // namespace

void CheckSize(const cv::Mat& image, const Camera& camera, const std::filesystem::path& file) {
  if (image.cols == camera.width() && image.rows == camera.height()) return;
  throw Error(fmt::format("{}: the picture is {} x {} px, the camera {} x {} px", file.string(),
                          image.cols, image.rows, camera.width(), camera.height()));
}

RunInputs ReadInputs(const RunArguments& arguments) {
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions{} : ReadOptions(arguments.config);
  const std::optional<CameraFile> named = ReadNamedCamera(arguments);
  ImageList list = ListImages(arguments.input, FrameRate(arguments, named));
  const std::filesystem::path first = list.images.front().file;
  const cv::Mat image = ReadGreyImage(first);
  if (!named && !list.camera) ThrowNoCamera(arguments, image.size());
  const Camera camera = named ? named->camera : Camera(*list.camera);
  CheckSize(image, camera, first);
  RunTruth truth = ReadRunTruth(arguments.truth, arguments.input, FrameTimes(list));
  return {options, camera, ImageSource(std::move(list)), std::move(truth)};
}

}  // namespace corvo
