// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"

namespace corvo {

/// The observations of a frame, for a later adjustment of the sequence, since the map does not keep
/// them. Each posed frame is reported when it is posed, which is once unless the map is discarded.
/// A keyframe is reported again when it is marginalized, with the current positions of the
/// landmarks that it observes. Before that, it is reported with those of its landmarks that are
/// marginalized together with another keyframe.
struct FrameObservations {
  int frame = 0;
  int segment = 0;              ///< At this time: it may be joined with another one later.
  KeyframeId keyframe = kNoId;  ///< kNoId in the report of a newly posed frame.
  std::vector<Observation> observations;  ///< Pixels and sigmas in single precision.
  std::vector<Eigen::Vector3d> in_world;  ///< Landmark positions; for keyframes only.
  std::vector<LandmarkMerge> merges;      ///< Merges since the previous posed frame.
  int num_joins = 0;                      ///< Number of joins of segments before; see ApplyJoins().
  /// Id of the first landmark of the map. A report with another one than those before it is of a
  /// new map, which replaces the one that they are of.
  LandmarkId first_landmark = 0;
};

using ObservationCallback = std::function<void(const FrameObservations&)>;

using LandmarkCallback = std::function<void(const MarginalizedLandmark&)>;

}  // namespace corvo
