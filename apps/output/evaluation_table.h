// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vo/evaluation/evaluation.h"

namespace corvo {

/// The evaluation of one of several results.
struct NamedEvaluation {
  std::string name;
  int num_poses = 0;
  std::optional<int> num_frames;  ///< Number of frames of the run, if it is known.
  Evaluation evaluation;
};

/// Returns a table for display with two rows for the names and units of the columns and one for
/// each result, in their order. The ATE and the RPE are root mean squares; "-" stands for what
/// cannot be measured.
std::string EvaluationTable(const std::vector<NamedEvaluation>& results);

/// Returns CSV with the errors of every pair: timestamp, translation_error_m and
/// rotation_error_deg, after a column with the name of the result if there are several.
std::string PoseErrorTable(const std::vector<NamedEvaluation>& results);

}  // namespace corvo
