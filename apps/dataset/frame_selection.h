// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// A selection of the frames in a run's frames.csv.
struct FrameSelection {
  std::vector<std::string> states;  ///< Names of the selected states; empty for all states.
  std::optional<int> segment;       ///< The selected segment; std::nullopt for all segments.

  bool SelectsAll() const { return states.empty() && !segment; }
};

/// Returns the poses whose timestamps are those of selected frames. Throws corvo::Error with file
/// and line if the table is malformed, and for an unknown state.
PoseSequence SelectFrames(const PoseSequence& poses, const std::filesystem::path& frames_csv,
                          const FrameSelection& selection);

}  // namespace corvo
