// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string_view>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_source.h"
#include "tests/data/temporary_folder.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {
namespace {

// The text files that the layouts of datasets consist of. Images need only exist to be listed.
constexpr std::array<std::string_view, 23> kTextFiles = {
    "times.txt",
    "calib.txt",
    "camera.txt",
    "rgb.txt",
    "groundtruth.txt",
    "groundtruthSync.txt",
    "frame-000000.pose.txt",
    "mav0/cam0/data.csv",
    "mav0/cam0/sensor.yaml",
    "mav0/mocap0/data.csv",
    "mav0/state_groundtruth_estimate0/data.csv",
    "dso/camchain.yaml",
    "dso/gt_imu.csv",
    "poses.txt",
    "associations.txt",
    "pose_left.txt",
    "image_times.txt",
    "calib_cam_to_cam.txt",
    "calib_velo_to_cam.txt",
    "calib_imu_to_velo.txt",
    "drive/image_00/timestamps.txt",
    "drive/oxts/timestamps.txt",
    "drive/oxts/data/0.txt",
};

void WriteImages(const test::TemporaryFolder& folder) {
  for (const char* name :
       {"image_0/000000.png", "image_0/000001.png", "images/00000.jpg", "images/00001.jpg",
        "rgb/1.png", "rgb/2.png", "mav0/cam0/data/1.png", "mav0/cam0/data/2.png",
        "frame-000000.color.png", "image_left/000000_left.png", "drive/image_00/data/0.png"}) {
    folder.Write(name, "");
  }
}

/// Writes a text in which a line "@@ NAME" precedes the contents of each file. Other names than
/// those of kTextFiles are left out: nothing is written outside the folder.
void WriteFiles(std::string_view text, const test::TemporaryFolder& folder) {
  constexpr std::string_view kMark = "@@ ";
  while (!text.empty()) {
    const std::size_t next = text.find("\n@@ ");
    std::string_view part = text.substr(0, next);
    text.remove_prefix(next == std::string_view::npos ? text.size() : next + 1);
    if (!part.starts_with(kMark)) continue;
    const std::size_t line = std::min(part.find('\n'), part.size());
    const std::string_view name = part.substr(kMark.size(), line - kMark.size());
    if (std::find(kTextFiles.begin(), kTextFiles.end(), name) == kTextFiles.end()) continue;
    folder.Write(std::string(name), std::string(part.substr(std::min(line + 1, part.size()))));
  }
}

void RequireImages(const ImageList& list) {
  for (std::size_t i = 1; i < list.images.size(); ++i) {
    Require(list.images[i - 1].time_ns < list.images[i].time_ns, "times of images ascend");
  }
  Require(!list.camera || list.camera->IsValid(), "the camera of a dataset is valid");
}

void ReadTruth(const std::filesystem::path& file) {
  const PoseFile truth = ReadTruthFile(file);
  for (const TimedPose& pose : truth.poses()) {
    Require(IsFinite(pose.world_from_camera), "ground truth is finite");
  }
}

}  // namespace

void FuzzDataset(Bytes bytes) {
  static const test::TemporaryFolder folder;
  folder.Clear();
  WriteImages(folder);
  WriteFiles(Input(bytes).Text(), folder);
  AllowError([] { RequireImages(ListImages(folder.path())); });
  AllowError([] { RequireImages(ListImages(folder.path() / "mav0")); });
  AllowError([] { RequireImages(ListImages(folder.path() / "drive")); });
  AllowError([] {
    InputOptions options;
    options.times = folder.path() / "image_times.txt";
    RequireImages(ListImages(folder.path() / "images", options));
  });
  for (const char* input : {"", "drive"}) {
    AllowError([&] {
      const std::filesystem::path truth = FindGroundTruth(folder.path() / input);
      if (!truth.empty()) ReadTruth(truth);
    });
  }
  for (const std::string_view name : kTextFiles) {
    if (name.find("data.csv") == name.npos && name != "dso/gt_imu.csv" && name != kTartanAirPoses) {
      continue;
    }
    AllowError([&] { ReadTruth(folder.path() / name); });
  }
}

}  // namespace corvo::fuzz
