// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"

namespace corvo {

/// What a frame observed, for those who want to adjust a sequence afterwards: the map forgets it.
/// Each posed frame is reported once, when it is posed. A keyframe is reported again, with what is
/// known by then of the landmarks it observes, when it leaves the map for good; and before that,
/// with some of its landmarks, when these leave together with another keyframe.
struct FrameObservations {
  int frame = 0;
  int segment = 0;
  KeyframeId keyframe = kNoId;            ///< kNoId: reported when the frame was posed.
  std::vector<Observation> observations;  ///< Pixels and sigmas in single precision.
  std::vector<Eigen::Vector3d> in_world;  ///< The landmark of each; for keyframes only.
  std::vector<LandmarkMerge> merges;      ///< Of landmarks, since the previous posed frame.
};

using ObservationCallback = std::function<void(const FrameObservations&)>;

using LandmarkCallback = std::function<void(const MarginalizedLandmark&)>;

}  // namespace corvo
