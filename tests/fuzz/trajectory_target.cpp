// SPDX-License-Identifier: MIT
#include "apps/dataset/pose_file.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"
#include "vo/io/trajectory_io.h"

namespace corvo::fuzz {
namespace {

void RequireSequence(const PoseSequence& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Require(IsFinite(poses[i].world_from_camera), "a pose that is read is finite");
    Require(i == 0 || poses[i - 1].time_ns < poses[i].time_ns, "times ascend");
  }
}

}  // namespace

void FuzzTrajectory(Bytes bytes) {
  const std::filesystem::path file = WriteScratchFile(Input(bytes).Text());
  AllowError([&] { RequireSequence(ReadPoseFile(file).poses()); });
  AllowError([&] { RequireSequence(ReadTumWithGaps(file)); });
  AllowError([&] { ReadKittiTimes(file); });
  AllowError([&] {
    for (const SE3& pose : ReadKittiPoses(file)) {
      Require(IsFinite(pose), "a pose that is read is finite");
    }
  });
  AllowError([&] { RequireSequence(ReadEurocPoses(file)); });
  AllowError([&] {
    const PoseSequence read = ReadTum(file);
    RequireSequence(read);
    WriteTum(file, read);
    Require(ReadTum(file).size() == read.size(), "a trajectory that is written is read back");
  });
}

}  // namespace corvo::fuzz
