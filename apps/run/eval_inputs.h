// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/core/trajectory.h"

namespace corvo {

/// What `corvo eval` compares. Empty paths were not given.
struct EvalFiles {
  std::filesystem::path estimate;  ///< A file of poses, or the folder that `corvo run` wrote.
  std::filesystem::path truth;     ///< A file of poses, or a sequence's folder in its layout;
                                   ///< without it, the groundtruth.tum that `corvo run` wrote.
  std::filesystem::path times;     ///< Of the rows of a file in KITTI format.
};

struct EvalInputs {
  std::filesystem::path estimate_file;
  std::filesystem::path truth_file;
  PoseSequence estimate;
  PoseSequence truth;
};

/// Finds and reads both. Two files in KITTI format are compared row by row, as poses a second
/// apart, unless there are times. Throws corvo::Error.
EvalInputs ReadEvalInputs(const EvalFiles& files);

}  // namespace corvo
