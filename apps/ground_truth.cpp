#include "apps/ground_truth.h"

#include <fmt/format.h>

#include "apps/body_from_camera.h"
#include "apps/pose_file.h"
#include "orb/error.h"
#include "vo/trajectory_io.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMonoTruth = "groundtruthSync.txt";

/// poses/XX.txt, where the sequence is sequences/XX.
fs::path KittiTruth(const fs::path& input) {
  if (input.parent_path().filename() != "sequences") return {};
  return input.parent_path().parent_path() / "poses" / (input.filename().string() + ".txt");
}

/// Without a separator at its end, and with the folder it lies in.
fs::path PlainFolder(const fs::path& input) {
  fs::path folder = input.lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const bool is_bare = !folder.has_parent_path() || folder.filename() == "..";
  return is_bare ? fs::absolute(folder).lexically_normal() : folder;
}

/// The body's poses, moved to cam0.
PoseSequence ReadBodyTruth(const fs::path& file) {
  const SE3 body_from_camera = ReadBodyFromCamera(file);
  PoseSequence poses = ReadEurocPoses(file);
  for (TimedPose& pose : poses) {
    pose.world_from_camera = pose.world_from_camera * body_from_camera;
  }
  return poses;
}

}  // namespace

fs::path FindGroundTruth(const fs::path& input) {
  if (!fs::is_directory(input)) return {};
  const fs::path folder = PlainFolder(input);
  const fs::path root = folder.filename() == "mav0" ? folder.parent_path() : folder;
  for (const fs::path& file :
       {KittiTruth(folder), root / "mav0/state_groundtruth_estimate0/data.csv",
        root / "mav0/mocap0/data.csv", root / "dso/gt_imu.csv", folder / "groundtruth.txt",
        folder / kMonoTruth}) {
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

PoseFile ReadTruthFile(const fs::path& file) {
  if (file.filename() == kMonoTruth) return PoseFile(ReadTumWithGaps(file));
  return IsEurocPoseFile(file) ? PoseFile(ReadBodyTruth(file)) : ReadPoseFile(file);
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
