// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// The ground truth that a run is compared with.
struct RunTruth {
  std::filesystem::path file;  ///< Empty if there is none.
  PoseSequence poses;          ///< Poses of the camera.
};

/// Returns the ground truth in the file `named`, or that of the dataset of `input` if `named` is
/// empty, or none if `named` is "none". `frame_times` are the timestamps of the whole sequence.
/// Throws corvo::Error if the file `named` cannot be used or does not overlap the sequence in time.
/// A dataset's ground truth is ignored with a warning in these cases.
RunTruth ReadRunTruth(const std::filesystem::path& named, const std::filesystem::path& input,
                      const std::vector<TimeNs>& frame_times);

}  // namespace corvo
