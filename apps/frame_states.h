#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vo/trajectory.h"

namespace corvo {

/// The poses of those frames that a run's frames.csv lists in one of the states, named as there.
/// Throws corvo::Error naming file and line, and for a state that frames cannot have.
PoseSequence SelectStates(const PoseSequence& poses, const std::filesystem::path& frames_csv,
                          const std::vector<std::string>& states);

}  // namespace corvo
