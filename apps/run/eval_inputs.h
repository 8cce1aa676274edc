// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/core/trajectory.h"

namespace corvo {

/// The files that `corvo eval` compares. An empty path was not given.
struct EvalFiles {
  std::filesystem::path estimate;  ///< Pose file, or output folder of `corvo run`.
  std::filesystem::path truth;     ///< Pose file, or folder of a dataset sequence. If empty, the
                                   ///< groundtruth.tum that `corvo run` wrote is used.
  std::filesystem::path times;     ///< File with the timestamps of the rows of a KITTI file.
};

struct EvalInputs {
  std::filesystem::path estimate_file;
  std::filesystem::path truth_file;
  PoseSequence estimate;
  PoseSequence truth;
  bool has_times = true;  ///< False for two KITTI files, whose rows are numbered.
};

/// Finds and reads both trajectories. Two files in KITTI format are compared row by row, as poses
/// one second apart, unless timestamps are available. Throws corvo::Error if a file is missing or
/// malformed.
EvalInputs ReadEvalInputs(const EvalFiles& files);

}  // namespace corvo
