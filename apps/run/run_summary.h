// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/output/calibration_report.h"
#include "apps/output/refinement_report.h"
#include "apps/run/outcome.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "vo/evaluation/evaluation.h"
#include "vo/offline/match_residuals.h"

namespace corvo {

/// The figures of a run. Nothing here depends on the machine or on time.
struct RunSummary {
  Outcome outcome = Outcome::kDone;
  int num_frames = 0;
  int num_posed = 0;
  int num_rotations = 0;  ///< Frames whose rotation is known, posed or not.
  int num_segments = 0;
  int num_keyframes = 0;
  int num_landmarks = 0;
  std::map<State, int> states;
  std::map<Reason, int> reasons;  ///< Of the frames that are not posed.
  std::map<AdjustmentStatus, int> window_adjustments;
  std::map<AdjustmentStatus, int> camera_adjustments;
  std::string why_not_kitti;  ///< Why there is no trajectory.kitti; empty if there is.
  std::optional<MatchResiduals> residuals;
  CalibrationReport calibration;
  std::optional<RefinementReport> refinement;  ///< Where it was asked for.
  std::optional<Evaluation> evaluation;        ///< Where there is ground truth to compare with.
  /// Of all rotations, over one second and in degrees; likewise.
  std::optional<ErrorStatistics> rotation_deg;
};

/// Warns of a calibration that does not fit the images.
RunSummary Summarize(const RunArguments& arguments, const RunInputs& inputs,
                     const RunRecord& record);

/// summary.json
nlohmann::ordered_json ToJson(const RunArguments& arguments, const RunInputs& inputs,
                              const RunSummary& summary);

/// What `corvo run` prints at the end.
std::string SummaryText(const RunArguments& arguments, const RunSummary& summary);

}  // namespace corvo
