// SPDX-License-Identifier: MIT
#include "apps/synthetic/writer.h"

#include <array>
#include <cstdint>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
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
  const std::vector<std::uint8_t> bytes = GetCodecs().EncodeImage(".png", image);
  if (bytes.empty()) throw Error(fmt::format("{}: cannot be encoded", file.string()));
  WriteText(file, {bytes.begin(), bytes.end()});
}

/// Returns the time in seconds with all nine decimals: 0.033333333.
std::string Seconds(TimeNs time_ns) {
  return fmt::format("{}.{:09}", time_ns / 1000000000, time_ns % 1000000000);
}

/// Returns whether images or texts have this name in the folder of a sequence, in any layout.
bool IsWrittenName(const std::string& name) {
  static const std::regex names(
      R"(rgb/\d+\.\d{9}\.png|(rgb|groundtruth|poses/00|sequences/00/(times|calib))\.txt|)"
      R"(sequences/00/image_0/\d{6,}\.png|mav0/cam0/(data/\d+\.png|data\.csv|sensor\.yaml)|)"
      R"(mav0/state_groundtruth_estimate0/data\.csv)");
  return std::regex_match(name, names);
}

/// Returns the files below the folders of all layouts.
std::vector<fs::path> ListFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : kWritten) {
    const fs::file_status status = fs::symlink_status(folder / name);
    if (fs::exists(status) && !fs::is_directory(status)) files.push_back(folder / name);
    if (!fs::is_directory(status)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / name)) {
      if (!fs::is_directory(entry.symlink_status())) files.push_back(entry.path());
    }
  }
  return files;
}

/// Removes a folder and its subfolders where they are empty.
void RemoveEmptyFolders(const fs::path& folder) {
  if (!fs::is_directory(fs::symlink_status(folder))) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    RemoveEmptyFolders(entry.path());
  }
  std::error_code ignored;
  fs::remove(folder, ignored);  // Fails unless it is empty.
}

/// Removes the images and texts of a sequence, and leaves files of other names.
void RemoveWritten(const fs::path& folder) {
  for (const fs::path& file : ListFiles(folder)) {
    if (IsWrittenName(file.lexically_relative(folder).string())) fs::remove(file);
  }
  for (const char* name : kWritten) RemoveEmptyFolders(folder / name);
}

/// Returns a file among those of an earlier sequence that has another name; empty if there is none.
fs::path FindForeignFile(const fs::path& folder) {
  for (const fs::path& file : ListFiles(folder)) {
    if (!IsWrittenName(file.lexically_relative(folder).string())) return file;
  }
  return {};
}

/// Creates the folder and removes the files of an earlier sequence in it. Throws corvo::Error if it
/// contains other files, unless `force` is set.
void ClaimFolder(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw Error(fmt::format("{}: is not a folder", folder.string()));
  }
  MakeFolder(folder);
  if (fs::exists(folder / kMarker)) {
    const fs::path foreign = FindForeignFile(folder);
    if (foreign.empty() || force) return RemoveWritten(folder);
    throw Error(
        fmt::format("{}: is not a file of a synthetic sequence; nothing was replaced: choose "
                    "another folder, or use --force to replace the files around it",
                    foreign.string()));
  }
  if (!fs::is_empty(folder) && !force) {
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
  RemoveWritten(folder);
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
