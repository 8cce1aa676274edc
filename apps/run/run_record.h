// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/output/frame_tables.h"
#include "apps/output/landmark_spool.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// What a run leaves behind, before anything is written.
struct RunRecord {
  explicit RunRecord(Odometry configured) : odometry(std::move(configured)) {}

  Odometry odometry;
  /// Landmarks that have left the odometry's map.
  std::unique_ptr<LandmarkSpool> finished = std::make_unique<LandmarkSpool>();
  ObservationLog observations;           ///< Only where the run is refined.
  std::optional<Refinement> refinement;  ///< Where it was asked for.
  Trajectory trajectory;  ///< As known after the last image; in meters where that was asked for.
  std::vector<FrameTiming> timings;
  double elapsed_s = 0;
  bool is_interrupted = false;  ///< Ended by Ctrl-C, before the last image.

  bool is_refined() const { return refinement && refinement->adjustment.is_usable(); }
};

}  // namespace corvo
