// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// What a run is compared with.
struct RunTruth {
  std::filesystem::path file;  ///< Empty if there is none.
  PoseSequence poses;          ///< Of the camera.
};

/// The truth in the file `named`, or else that which the dataset of `input` has in its layout; none
/// for "none". `frame_times` are those of the whole sequence. Throws corvo::Error where the named
/// file cannot be used or belongs to another time; what the layout has is then left out with a
/// warning.
RunTruth ReadRunTruth(const std::filesystem::path& named, const std::filesystem::path& input,
                      const std::vector<TimeNs>& frame_times);

}  // namespace corvo
