// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/dataset/frame_selection.h"
#include "apps/output/evaluation_table.h"
#include "apps/run/eval_inputs.h"

namespace corvo {

/// The arguments of `corvo eval`. An empty path was not given.
struct EvalArguments {
  std::vector<std::filesystem::path> results;  ///< The last of two may be the ground truth.
  std::filesystem::path truth;                 ///< Empty if --gt was not given.
  std::filesystem::path times;
  std::filesystem::path image;
  std::filesystem::path pose_errors;
  std::filesystem::path frames;  ///< If empty, the frames.csv beside the estimate.
  FrameSelection selection;
  std::string alignment = "sim3";
  std::optional<double> max_dt_s;
  std::optional<double> rpe_meters;
  int rpe_frames = 1;
  double rpe_seconds = 1;
  double time_offset_s = 0;
  bool json = false;
  bool force = false;
};

/// One result with its ground truth and its evaluation.
struct EvaluatedResult {
  EvalInputs inputs;
  NamedEvaluation named;
};

/// Evaluates the results one by one. Logs a warning if the timestamps of one seem to have an
/// offset. Throws corvo::Error if the arguments contradict each other or a result cannot be
/// evaluated; with several results, the message names the one.
std::vector<EvaluatedResult> EvaluateResults(const EvalArguments& arguments);

}  // namespace corvo
