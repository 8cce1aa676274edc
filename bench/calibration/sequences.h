// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// The rendered scenes for a calibration.
enum class RenderScene {
  kStreet,    ///< A drive with bends and right angles.
  kRoom,      ///< A walk around a room.
  kStraight,  ///< A drive straight on.
  kRotation,  ///< A camera that turns about its own center.
};

std::string ToString(RenderScene scene);

/// Returns a part of a scene in small images. `seed` determines its start and the pixel noise.
/// Deterministic. Images are rendered beforehand, because they are used more than once.
Recording SequencePart(RenderScene scene, int seed);

}  // namespace corvo::bench
