// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/offline/camera_selection.h"

namespace corvo {

/// A line for each candidate, the selected one marked: parameters, root mean square error, robust
/// cost and information criterion.
std::string CandidatesText(const std::vector<CameraCandidate>& candidates, int selected);

/// Each free parameter of an adjusted candidate: value, standard deviation, and the correlations
/// with those before it.
std::string EstimateText(const CameraCandidate& candidate);

/// What the motion does not determine, and what to record instead; a sentence each.
std::vector<std::string> UndeterminedWarnings(const CameraCandidate& candidate);

}  // namespace corvo
