// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// Which frames of a run's frames.csv are meant.
struct FrameSelection {
  std::vector<std::string> states;  ///< Those in one of these, named as there; empty: in any.
  std::optional<int> segment;       ///< Those of this segment; none: of any.

  bool SelectsAll() const { return states.empty() && !segment; }
};

/// The poses of the selected frames, found by their times. Throws corvo::Error naming file and
/// line, and for a state that frames cannot have.
PoseSequence SelectFrames(const PoseSequence& poses, const std::filesystem::path& frames_csv,
                          const FrameSelection& selection);

}  // namespace corvo
