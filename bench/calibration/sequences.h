// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// What is filmed for a calibration.
enum class RenderScene {
  kStreet,    ///< A drive with bends and right angles.
  kRoom,      ///< A walk round a room.
  kStraight,  ///< A drive straight on.
  kRotation,  ///< A camera that turns about its own center.
};

std::string ToString(RenderScene scene);

/// A stretch of a scene in small images, from a start and with a pixel noise that change with
/// `seed`. Deterministic. Images are rendered beforehand, to be seen more than once.
Recording SequencePart(RenderScene scene, int seed);

}  // namespace corvo::bench
