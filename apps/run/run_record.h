// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/output/camera_history.h"
#include "apps/output/frame_tables.h"
#include "apps/output/keyframe_features.h"
#include "apps/output/landmark_colors.h"
#include "apps/output/landmark_spool.h"
#include "apps/output/realtime_report.h"
#include "vo/odometry.h"
#include "vo/offline/calibration_check.h"
#include "vo/offline/metric_scale.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// How a run ended.
struct RunEnd {
  std::string why;  ///< Why it ended before the last image or its refinement; empty if it did not.
  int exit_code = 0;  ///< The exit code if it did.

  bool is_complete() const { return why.empty(); }
};

/// The data that a run produces, before anything is written.
struct RunRecord {
  explicit RunRecord(Odometry configured) : odometry(std::move(configured)) {}

  Odometry odometry;
  /// Landmarks that were removed from the odometry's map.
  std::unique_ptr<LandmarkSpool> finished = std::make_unique<LandmarkSpool>();
  ObservationLog observations;
  std::optional<Refinement> refinement;   ///< Set only if refinement is requested.
  Trajectory trajectory;                  ///< Final estimate, in meters if `metric` is set.
  std::optional<MetricTransform> metric;  ///< Set if the scale was given or determined.
  std::string why_not_metric;  ///< What is not in meters, and why; empty if nothing or not asked.
  PoseGraph graph;             ///< Of the keyframes, in the unit of the trajectory.
  CalibrationCheck check;
  std::vector<FrameTiming> timings;
  std::vector<std::string> images;  ///< Name of the image of each frame, see ImageNames.
  CameraHistory cameras;
  LandmarkColors colors;
  std::optional<KeyframeFeatureSpool> features;  ///< Of the keyframes, if they are to be written.
  std::map<Reason, std::string> first_errors;    ///< The first missing image of each reason.
  std::optional<RealtimeReport> realtime;        ///< Set if images were taken in real time.
  double elapsed_s = 0;
  RunEnd end;

  bool is_refined() const { return refinement && refinement->adjustment.is_usable(); }
};

}  // namespace corvo
