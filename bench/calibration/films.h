#pragma once

#include <string>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// What is filmed for a calibration.
enum class FilmScene {
  kStreet,    ///< A drive with bends and right angles.
  kRoom,      ///< A walk round a room.
  kStraight,  ///< A drive straight on.
  kRotation,  ///< A camera that turns about its own centre.
};

std::string ToString(FilmScene scene);

/// A stretch of a scene in small pictures, from a start and with a pixel noise that change with
/// `seed`. Deterministic. Pictures are rendered beforehand, to be seen more than once.
Recording FilmStretch(FilmScene scene, int seed);

}  // namespace corvo::bench
