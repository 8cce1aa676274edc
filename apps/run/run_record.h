#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/output/frame_tables.h"
#include "apps/output/landmark_spool.h"
#include "apps/output/observation_spool.h"
#include "vo/odometry.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// What a run leaves behind, before anything is written.
struct RunRecord {
  Odometry odometry;
  std::unique_ptr<LandmarkSpool> finished;         ///< Landmarks that have left the odometry's map.
  std::unique_ptr<ObservationSpool> observations;  ///< What frames saw; only where that is refined.
  std::optional<Refinement> refinement;            ///< Where it was asked for.
  Trajectory trajectory;  ///< As known after the last image; in meters where that was asked for.
  std::vector<FrameTiming> timings;
  double elapsed_s = 0;
  bool is_interrupted = false;  ///< Ended by Ctrl-C, before the last image.

  bool is_refined() const {
    return refinement && refinement->adjustment.outcome == AdjustmentOutcome::kImproved;
  }
};

}  // namespace corvo
