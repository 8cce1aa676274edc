// SPDX-License-Identifier: MIT
#include "apps/dataset/ground_truth.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "apps/dataset/body_from_camera.h"
#include "apps/dataset/image_layouts.h"
#include "apps/dataset/kitti_raw_truth.h"
#include "apps/dataset/pose_file.h"
#include "orb/error.h"
#include "vo/io/pose_rows.h"
#include "vo/io/text_lines.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMonoTruth = "groundtruthSync.txt";

/// Returns poses/XX.txt if the sequence is sequences/XX, otherwise an empty path.
fs::path KittiTruth(const fs::path& input) {
  if (input.parent_path().filename() != "sequences") return {};
  return input.parent_path().parent_path() / "poses" / (input.filename().string() + ".txt");
}

/// Returns oxts of the drive if the folder is a drive of KITTI's raw data, or the folder of a
/// camera or of images in one.
fs::path KittiRawTruth(fs::path folder) {
  if (folder.filename() == "data") folder = folder.parent_path();
  if (folder.filename().string().starts_with("image_")) folder = folder.parent_path();
  return folder / kKittiRawTruth;
}

/// Returns the normalized path without a trailing separator, made absolute if it has no parent.
fs::path PlainFolder(const fs::path& input) {
  fs::path folder = input.lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const bool is_bare = !folder.has_parent_path() || folder.filename() == "..";
  return is_bare ? fs::absolute(folder).lexically_normal() : folder;
}

/// Transforms poses of the body to cam0.
PoseSequence MoveToCamera(PoseSequence poses, const fs::path& file) {
  const SE3 body_from_camera = ReadBodyFromCamera(file);
  for (TimedPose& pose : poses) {
    pose.world_from_camera = pose.world_from_camera * body_from_camera;
  }
  return poses;
}

/// Reads "tx ty tz qx qy qz qw" per line: the camera's poses, whose axes are x forward, y right, z
/// down (Wang et al., TartanAir, IROS 2020).
PoseFile ReadTartanAirTruth(const fs::path& file) {
  std::vector<TextLine> lines = ReadTableLines(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].text = fmt::format("{} {}", i, lines[i].text);  // As in TUM format.
  }
  const SO3 forward_from_camera(Eigen::Matrix3d{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}});
  std::vector<SE3> poses;
  for (const TimedPose& pose : ParseTumRows(lines, file)) {
    poses.push_back(pose.world_from_camera * SE3(forward_from_camera, Eigen::Vector3d::Zero()));
  }
  return PoseFile(poses);
}

/// Returns the `.pose.txt` files of a folder in natural order.
std::vector<fs::path> PoseFilesIn(const fs::path& folder) {
  constexpr std::string_view kEnd = ".pose.txt";
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ends = name.size() > kEnd.size() &&
                      name.compare(name.size() - kEnd.size(), kEnd.size(), kEnd) == 0;
    if (ends) files.push_back(entry.path());
  }
  SortByName(files);
  return files;
}

/// Reads world_from_camera, a 4x4 matrix with one row per line.
SE3 ReadPoseMatrix(const fs::path& file) {
  std::vector<double> numbers;
  for (const TextLine& line : ReadTextLines(file)) {
    for (const std::string& field : SplitFields(line.text)) {
      numbers.push_back(ParseNumber(field, LinePrefix(file, line)));
    }
  }
  if (numbers.size() != 16) {
    throw Error(fmt::format("{}: {} numbers; a 4x4 matrix has 16", file.string(), numbers.size()));
  }
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers.data());
  try {
    const SE3 pose(SO3(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
                   matrix.topRightCorner<3, 1>());
    CheckPose("the pose", pose);
    return pose;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::vector<SE3> ReadPoseMatrices(const fs::path& folder) {
  std::vector<SE3> poses;
  for (const fs::path& file : PoseFilesIn(folder)) poses.push_back(ReadPoseMatrix(file));
  return poses;
}

}  // namespace

fs::path FindGroundTruth(const fs::path& input) {
  if (!fs::is_directory(input)) return {};
  const fs::path folder = PlainFolder(input);
  const fs::path root = folder.filename() == "mav0" ? folder.parent_path() : folder;
  const fs::path measured = KittiRawTruth(folder);
  if (IsKittiRawTruth(measured)) return measured;
  for (const fs::path& file :
       {KittiTruth(folder), root / "mav0/state_groundtruth_estimate0/data.csv",
        root / "mav0/mocap0/data.csv", root / "dso/gt_imu.csv", folder / "groundtruth.txt",
        folder / kMonoTruth, folder / kTartanAirPoses}) {
    if (fs::is_regular_file(file)) return file;
  }
  return PoseFilesIn(folder).empty() ? fs::path() : folder;
}

PoseFile ReadTruthFile(const fs::path& file) {
  if (IsKittiRawTruth(file)) return PoseFile(ReadKittiRawTruth(file));
  if (fs::is_directory(file)) return PoseFile(ReadPoseMatrices(file));
  if (file.filename() == kTartanAirPoses) return ReadTartanAirTruth(file);
  if (file.filename() == kMonoTruth) return PoseFile(ReadTumWithGaps(file));
  PoseFile poses = ReadPoseFile(file);
  return poses.is_euroc() ? PoseFile(MoveToCamera(poses.poses(), file)) : poses;
}

PoseSequence ReadGroundTruth(const fs::path& file, const std::vector<TimeNs>& frame_times) {
  const PoseFile poses = ReadTruthFile(file);
  if (!poses.has_times() && poses.size() != frame_times.size()) {
    throw Error(fmt::format("{}: {} poses for a sequence of {} frames", file.string(), poses.size(),
                            frame_times.size()));
  }
  return poses.WithTimes(frame_times);
}

}  // namespace corvo
