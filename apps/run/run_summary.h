// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/dataset/image_reader.h"
#include "apps/output/calibration_report.h"
#include "apps/output/refinement_report.h"
#include "apps/run/outcome.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_warnings.h"
#include "vo/evaluation/evaluation.h"
#include "vo/offline/calibration_check.h"
#include "vo/offline/match_residuals.h"
#include "vo/offline/parameter_check.h"

namespace corvo {

/// The figures of a run. They do not depend on the machine or on timing.
struct RunSummary {
  Outcome outcome = Outcome::kDone;
  RunEnd end;
  int num_frames = 0;
  std::optional<int> num_expected;  ///< Number of selected images, if it is known.
  std::optional<VideoFrames> video;
  int num_posed = 0;
  int num_rotations = 0;          ///< Number of frames with a rotation, with or without a pose.
  int num_repeated = 0;           ///< Number of frames whose image repeats that of an earlier one.
  int num_blurred = 0;            ///< See CountBlurredFrames.
  double masked_share = 0;        ///< Mean share of the image that moves with the camera, 0 to 1.
  std::vector<Segment> segments;  ///< The segments that have poses.
  int num_keyframes = 0;
  int num_landmarks = 0;
  std::map<State, int> states;
  std::map<Reason, int> reasons;  ///< Number of frames without a pose, by reason.
  std::map<AdjustmentStatus, int> window_adjustments;
  std::map<AdjustmentStatus, int> camera_adjustments;
  std::string why_not_kitti;  ///< Why there is no trajectory.kitti; empty if there is one.
  std::optional<MatchResiduals> residuals;
  CalibrationCheck check;
  std::vector<MisfittingParameter> misfitting;
  CalibrationReport calibration;
  std::vector<FrameRange> uncertain_scale;  ///< Frames at which the scale may have changed.
  /// The ATE that the covariances let expect, in the unit of the trajectory, and as a share of the
  /// path; see ExpectedDrift().
  double expected_ate = 0;
  double expected_ate_of_path = 0;
  std::vector<FrameRange> least_certain;       ///< The tenth of the frames with the largest drift.
  std::vector<std::string> warnings;           ///< What is doubtful about the result.
  std::optional<RefinementReport> refinement;  ///< Set if refinement was requested.
  std::optional<Evaluation> evaluation;        ///< Set if there is usable ground truth.
  /// The relative errors of all rotations over one second, in degrees, if there is usable ground
  /// truth.
  std::optional<ErrorStatistics> rotation_deg;
};

/// Returns the figures of a run. Logs its warnings.
RunSummary Summarize(const RunArguments& arguments, const RunInputs& inputs,
                     const RunRecord& record);

/// Returns the content of summary.json.
nlohmann::ordered_json ToJson(const RunArguments& arguments, const RunInputs& inputs,
                              const RunSummary& summary);

/// Returns the text that `corvo run` prints at the end.
std::string SummaryText(const RunArguments& arguments, const RunSummary& summary);

}  // namespace corvo
