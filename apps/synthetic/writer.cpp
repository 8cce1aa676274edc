// SPDX-License-Identifier: MIT
#include "apps/synthetic/writer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "apps/synthetic/euroc_layout.h"
#include "apps/synthetic/files.h"
#include "orb/error.h"

namespace corvo::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "synthetic.yaml";
/// The files and folders of the images and texts of all layouts.
constexpr std::array<const char*, 6> kWritten = {"rgb",          "rgb.txt",      "groundtruth.txt",
                                                 "sequences/00", "poses/00.txt", "mav0"};
/// The largest number of pixels of a rendered image.
constexpr std::int64_t kMaxPixels = 100'000'000;

void WriteImage(const fs::path& file, const cv::Mat& image) {
  // Unlike cv::imwrite(), WriteText() notices a full disk.
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes)) {
    throw Error(fmt::format("{}: cannot be encoded", file.string()));
  }
  WriteText(file, {bytes.begin(), bytes.end()});
}

/// Returns the time in seconds with all nine decimals: 0.033333333.
std::string Seconds(TimeNs time_ns) {
  return fmt::format("{}.{:09}", time_ns / 1000000000, time_ns % 1000000000);
}

/// Creates the folder and removes the files of an earlier sequence in it. Throws corvo::Error if it
/// contains other files, unless `force` is set.
void ClaimFolder(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw Error(fmt::format("{}: is not a folder", folder.string()));
  }
  MakeFolder(folder);
  if (fs::exists(folder / kMarker)) {
    for (const char* name : kWritten) fs::remove_all(folder / name);
  } else if (!fs::is_empty(folder) && !force) {
    throw Error(
        fmt::format("{}: contains files that are not a synthetic sequence; choose another folder, "
                    "or use --force to overwrite them",
                    folder.string()));
  }
}

std::string CameraYaml(const Sequence& sequence) {
  std::string text = "model: " + std::string(ToString(sequence.camera().parameters().model)) + "\n";
  CameraParameters::Visit(sequence.camera().parameters(),
                          [&](const char* name, const auto& value, const auto&...) {
                            text += fmt::format("{}: {}\n", name, value);
                          });
  return text + fmt::format("frame_rate_hz: {}\n", sequence.frame_rate_hz());
}

std::string Description(const Sequence& sequence) {
  const SequenceOptions& options = sequence.options();
  const Effects& effects = options.effects;
  return fmt::format(
      "scene: {}\nfingerprint: {:016x}\nframes: {}\nnoise_sigma: {}\nnoise_seed: {}\n"
      "dark_s: [{}, {}]\nblur_s: [{}, {}]\nexposure_drift: {}\nvignetting: {}\n"
      "moving_share: {}\n",
      sequence.name(), sequence.scene().Fingerprint(), options.frames, options.noise_sigma,
      options.noise_seed, effects.dark.start_s, effects.dark.duration_s, effects.blur.start_s,
      effects.blur.duration_s, effects.exposure_drift, effects.vignetting, effects.moving_share);
}

std::string TumPose(const TimedPose& pose) {
  const Eigen::Vector3d& t = pose.world_from_camera.translation();
  const Eigen::Quaterniond& q = pose.world_from_camera.rotation().quaternion();
  return fmt::format("{} {} {} {} {} {} {} {}\n", Seconds(pose.time_ns), t.x(), t.y(), t.z(), q.x(),
                     q.y(), q.z(), q.w());
}

/// Returns the entries of the 3x4 matrix, row by row.
std::string KittiRow(const Eigen::Matrix<double, 3, 4>& matrix) {
  std::vector<double> entries;
  for (int i = 0; i < 12; ++i) entries.push_back(matrix(i / 4, i % 4));
  return fmt::format("{}\n", fmt::join(entries, " "));
}

void WriteTumTexts(const Sequence& sequence, const fs::path& folder) {
  std::string images = "# timestamp filename\n";
  std::string truth = "# timestamp tx ty tz qx qy qz qw (world from camera)\n";
  for (const TimedPose& pose : sequence.poses()) {
    images += fmt::format("{0} rgb/{0}.png\n", Seconds(pose.time_ns));
    truth += TumPose(pose);
  }
  WriteText(folder / "rgb.txt", images);
  WriteText(folder / "groundtruth.txt", truth);
}

void CheckNumPixels(const Camera& camera) {
  const std::int64_t num_pixels = std::int64_t{camera.width()} * camera.height();
  CheckRange("number of pixels of an image", num_pixels, std::int64_t{1}, kMaxPixels);
}

/// Throws corvo::Error if the layout cannot represent the camera.
void CheckLayout(const CameraParameters& camera, Layout layout) {
  const bool pinhole = camera.model == CameraModel::kPinhole;
  const bool distorted = !pinhole || camera.k1 != 0 || camera.k2 != 0 || camera.p1 != 0 ||
                         camera.p2 != 0 || camera.k3 != 0;
  if (layout == Layout::kKitti && distorted) {
    throw Error("the layout kitti cannot represent a camera with distortion");
  }
  if (layout == Layout::kEuroc && camera.model == CameraModel::kFov) {
    throw Error("the layout euroc supports pinhole-radtan and kb4 cameras, not fov");
  }
}

void WriteKittiTexts(const Sequence& sequence, const fs::path& folder) {
  MakeFolder(folder / "sequences/00");
  std::string times, poses, calibration;
  for (const TimedPose& pose : sequence.poses()) {
    times += Seconds(pose.time_ns) + "\n";
    poses += KittiRow(pose.world_from_camera.matrix().topRows<3>());
  }
  const Camera& camera = sequence.camera();
  Eigen::Matrix<double, 3, 4> projection;
  projection << camera.fx(), 0, camera.cx(), 0, 0, camera.fy(), camera.cy(), 0, 0, 0, 1, 0;
  for (int i = 0; i < 4; ++i) calibration += fmt::format("P{}: {}", i, KittiRow(projection));
  MakeFolder(folder / "poses");
  WriteText(folder / "poses/00.txt", poses);
  WriteText(folder / "sequences/00/times.txt", times);
  WriteText(folder / "sequences/00/calib.txt", calibration);
}

fs::path ImageFile(const Sequence& sequence, Layout layout, int frame) {
  if (layout == Layout::kKitti) return fmt::format("sequences/00/image_0/{:06}.png", frame);
  const TimeNs time_ns = sequence.poses()[static_cast<std::size_t>(frame)].time_ns;
  if (layout == Layout::kEuroc) return EurocImage(time_ns);
  return fmt::format("rgb/{}.png", Seconds(time_ns));
}

void WriteTexts(const Sequence& sequence, const fs::path& folder, Layout layout) {
  switch (layout) {
    case Layout::kTum:
      return WriteTumTexts(sequence, folder);
    case Layout::kKitti:
      return WriteKittiTexts(sequence, folder);
    case Layout::kEuroc:
      return WriteEurocTexts(sequence, folder);
  }
}

}  // namespace

void RemoveSequence(const fs::path& folder) {
  for (const char* name : kWritten) fs::remove_all(folder / name);
  for (const char* name : {"camera.yaml", kMarker}) fs::remove(folder / name);
}

void WriteSequence(const Sequence& sequence, const fs::path& folder, Layout layout, bool force,
                   const std::function<void(int)>& progress) {
  CheckLayout(sequence.camera().parameters(), layout);
  CheckNumPixels(sequence.camera());
  ClaimFolder(folder, force);
  WriteText(folder / kMarker, Description(sequence));
  WriteText(folder / "camera.yaml", CameraYaml(sequence));
  WriteTexts(sequence, folder, layout);
  MakeFolder((folder / ImageFile(sequence, layout, 0)).parent_path());
  for (int i = 0; i < sequence.size(); ++i) {
    WriteImage(folder / ImageFile(sequence, layout, i), sequence.Render(i));
    if (progress) progress(i + 1);
  }
}

}  // namespace corvo::synthetic
