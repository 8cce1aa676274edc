// SPDX-License-Identifier: MIT
#include "apps/run/eval_inputs.h"

#include <fmt/format.h>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/pose_file.h"
#include "apps/run/result_folder.h"
#include "orb/error.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

fs::path FindEstimate(const fs::path& given) {
  if (!fs::is_directory(given)) return given;
  CheckResultFile(given, "trajectory.tum");
  return given / "trajectory.tum";
}

fs::path FindTruth(const EvalFiles& files) {
  const fs::path& given = files.truth;
  if (given.empty()) {
    const fs::path written = files.estimate / "groundtruth.tum";
    if (fs::is_regular_file(written)) {
      CheckResultFile(files.estimate, "groundtruth.tum");
      return written;
    }
    throw Error(fmt::format("{}: no ground truth: give GT", written.string()));
  }
  if (!fs::is_directory(given)) return given;
  const fs::path file = FindGroundTruth(given);
  if (file.empty()) {
    throw Error(
        fmt::format("{}: no ground truth in the layout of KITTI, EuRoC, TUM RGB-D, TUM-VI or "
                    "TUM-mono; give the file",
                    given.string()));
  }
  return file;
}

/// Returns the file given by --times, or else the times.txt in the ground truth folder (KITTI).
/// Empty if there is neither.
fs::path FindTimes(const EvalFiles& files) {
  if (!files.times.empty()) return files.times;
  if (files.truth.empty()) return {};
  const fs::path times = files.truth / "times.txt";
  return fs::is_regular_file(times) ? times : fs::path();
}

/// Returns the poses with their own timestamps, or else with those of `times_file`, if given.
PoseSequence WithTimesOf(const PoseFile& poses, const fs::path& file, const fs::path& times_file) {
  if (poses.has_times() || times_file.empty()) return poses.poses();
  const std::vector<TimeNs> times = ReadKittiTimes(times_file);
  if (poses.size() != times.size()) {
    throw Error(fmt::format("{}: {} timestamps for {} poses in {}", times_file.string(),
                            times.size(), poses.size(), file.string()));
  }
  return poses.WithTimes(times);
}

}  // namespace

EvalInputs ReadEvalInputs(const EvalFiles& files) {
  EvalInputs inputs{FindEstimate(files.estimate), FindTruth(files), {}, {}, true};
  const PoseFile estimate = ReadPoseFile(inputs.estimate_file);
  const PoseFile truth = ReadTruthFile(inputs.truth_file);
  const fs::path times = FindTimes(files);
  if (estimate.has_times() != truth.has_times() && times.empty()) {
    const fs::path& without = estimate.has_times() ? inputs.truth_file : inputs.estimate_file;
    throw Error(
        fmt::format("{}: KITTI format has no timestamps; give --times FILE with the timestamp of "
                    "each row (the sequence's times.txt)",
                    without.string()));
  }
  if (!estimate.has_times() && !truth.has_times() && estimate.size() != truth.size()) {
    throw Error(fmt::format("{}: {} poses, but {} in {}; KITTI files are compared row by row",
                            inputs.estimate_file.string(), estimate.size(), truth.size(),
                            inputs.truth_file.string()));
  }
  inputs.estimate = WithTimesOf(estimate, inputs.estimate_file, times);
  inputs.truth = WithTimesOf(truth, inputs.truth_file, times);
  inputs.has_times = estimate.has_times() || truth.has_times() || !times.empty();
  return inputs;
}

}  // namespace corvo
