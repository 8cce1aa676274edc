// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/offline/camera_selection.h"

namespace corvo {

/// Returns a table with one line per candidate: number of free parameters, root mean square error,
/// robust cost and information criterion. The selected candidate is marked.
std::string CandidatesText(const std::vector<CameraCandidate>& candidates, int selected);

/// Returns a table with one line per free parameter of an adjusted candidate: value, standard
/// deviation, and correlations with the preceding parameters.
std::string EstimateText(const CameraCandidate& candidate);

/// Returns one warning for each group of parameters that the motion does not determine, with advice
/// on what to record.
std::vector<std::string> UndeterminedWarnings(const CameraCandidate& candidate);

}  // namespace corvo
