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

/// A part of a scene: `seed` determines its start and the pixel noise.
struct ScenePart {
  RenderScene scene = RenderScene::kStreet;
  int seed = 0;
  int frames = 200;  ///< Of kStraight, those between two bends instead.
};

/// Returns a part of a scene in small images. Deterministic. Images are rendered beforehand,
/// because they are used more than once.
Recording Render(const ScenePart& part);

}  // namespace corvo::bench
