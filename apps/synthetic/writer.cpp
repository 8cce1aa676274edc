#include "apps/synthetic/writer.h"

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "orb/error.h"

namespace corvo::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "synthetic.yaml";

void MakeFolder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw Error(fmt::format("{}: {}", folder.string(), code.message()));
}

void WriteText(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw Error(fmt::format("{}: cannot be written", file.string()));
}

void WritePicture(const fs::path& file, const cv::Mat& image) {
  if (!cv::imwrite(file.string(), image)) {
    throw Error(fmt::format("{}: cannot be written", file.string()));
  }
}

/// Exact: 0.033333333.
std::string Seconds(TimeNs time_ns) {
  return fmt::format("{}.{:09}", time_ns / 1000000000, time_ns % 1000000000);
}

/// Makes sure that writing into the folder destroys nobody's work, and removes what an earlier
/// sequence left there.
void ClaimFolder(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw Error(fmt::format("{}: is not a folder", folder.string()));
  }
  MakeFolder(folder);
  if (fs::exists(folder / kMarker)) {
    for (const char* name : {"rgb", "rgb.txt", "groundtruth.txt", "sequences/00", "poses/00.txt"}) {
      fs::remove_all(folder / name);
    }
  } else if (!fs::is_empty(folder) && !force) {
    throw Error(fmt::format(
        "{}: holds files that are not a synthetic sequence; choose another folder, or use --force "
        "to overwrite",
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
  return fmt::format(
      "scene: {}\nfingerprint: {:016x}\nframes: {}\nnoise_sigma: {}\nnoise_seed: {}\n",
      sequence.name(), sequence.scene().Fingerprint(), options.frames, options.noise_sigma,
      options.noise_seed);
}

std::string TumPose(const TimedPose& pose) {
  const Eigen::Vector3d& t = pose.world_from_camera.translation();
  const Eigen::Quaterniond& q = pose.world_from_camera.rotation().quaternion();
  return fmt::format("{} {} {} {} {} {} {} {}\n", Seconds(pose.time_ns), t.x(), t.y(), t.z(), q.x(),
                     q.y(), q.z(), q.w());
}

/// The upper three rows of the matrix, row by row.
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

void WriteKittiTexts(const Sequence& sequence, const fs::path& folder) {
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

fs::path PictureFile(const Sequence& sequence, Layout layout, int frame) {
  if (layout == Layout::kKitti) return fmt::format("sequences/00/image_0/{:06}.png", frame);
  const TimeNs time_ns = sequence.poses()[static_cast<std::size_t>(frame)].time_ns;
  return fmt::format("rgb/{}.png", Seconds(time_ns));
}

}  // namespace

void WriteSequence(const Sequence& sequence, const fs::path& folder, Layout layout, bool force,
                   const std::function<void(int)>& progress) {
  ClaimFolder(folder, force);
  WriteText(folder / kMarker, Description(sequence));
  WriteText(folder / "camera.yaml", CameraYaml(sequence));
  MakeFolder((folder / PictureFile(sequence, layout, 0)).parent_path());
  layout == Layout::kTum ? WriteTumTexts(sequence, folder) : WriteKittiTexts(sequence, folder);
  for (int i = 0; i < sequence.size(); ++i) {
    WritePicture(folder / PictureFile(sequence, layout, i), sequence.Render(i));
    if (progress) progress(i + 1);
  }
}

}  // namespace corvo::synthetic
