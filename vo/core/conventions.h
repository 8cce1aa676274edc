// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

/// The conventions of corvo.
///
/// Transforms are named `target_from_source`, points `x_in_frame`:
///
///     x_in_world = world_from_camera * x_in_camera
///
/// Camera axes: x right, y down, z forward. Integer pixel coordinates are pixel centers. Time is
/// integer nanoseconds. Names state units other than SI (`_px`, `_deg`, `_ms`).
///
/// The scale of a monocular trajectory is arbitrary: every pose belongs to a segment, and only
/// poses of one segment are comparable.
///
/// SE3 is stored as [qx qy qz qw tx ty tz]. Perturbations act on the right, translation first:
/// `T * Exp([υ ω])`; covariances use the same tangent.
namespace corvo {

/// Ids are dense, start at 0 in creation order and are never reused.
using KeyframeId = int;
using LandmarkId = int;
inline constexpr int kNoId = -1;  ///< The absence of a keyframe, landmark or keypoint.

using TimeNs = std::int64_t;

/// The largest magnitude of a time of a frame or pose (146 years), so that differences of times do
/// not overflow.
inline constexpr TimeNs kMaxTimeNs = TimeNs{1} << 62;

inline double ToSeconds(TimeNs time_ns) { return 1e-9 * static_cast<double>(time_ns); }

}  // namespace corvo
