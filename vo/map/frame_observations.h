#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/map/map.h"

namespace corvo {

/// A landmark as a frame saw it.
struct LandmarkSighting {
  LandmarkId landmark = kNoId;
  Eigen::Vector2f pixel;
  float sigma_px = 1;

  bool operator==(const LandmarkSighting&) const = default;
};

/// What a frame saw, for those who want to adjust a sequence afterwards: the map forgets it. Each
/// posed frame comes once, when it is posed. A keyframe comes again, with what is known by then of
/// what it sees, when it leaves the map for good; and before that, with some landmarks of its own,
/// when these leave with another keyframe.
struct FrameSightings {
  int frame = 0;
  int segment = 0;
  KeyframeId keyframe = kNoId;  ///< kNoId: of a frame that was posed.
  std::vector<LandmarkSighting> landmarks;
  std::vector<Eigen::Vector3d> in_world;  ///< Of each of `landmarks`; of a keyframe only.
  std::vector<LandmarkMerge> merges;      ///< Of landmarks, since the frame before.
};

using SightingsSink = std::function<void(const FrameSightings&)>;

/// Calls a sink with everything that an odometry gave to its own, in the same order.
using SightingsSource = std::function<void(const SightingsSink&)>;

}  // namespace corvo
