// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// Moves keypoint `k` of a frame with an approximately known pose to the pixel that shows exactly
/// what the landmark's reference shows: corners are detected to about a pixel of their level, and
/// differences from frame to frame would bias the scale of the map. The patch of the reference is
/// taken as a plane parallel to its image. Returns false and leaves the keypoint unchanged if the
/// patches do not fit or are missing.
bool AlignKeypoint(const Map& map, const Landmark& landmark, Frame& frame, int k);

/// Like AlignKeypoint, but for an observation of the map. Returns false for the reference.
bool AlignTrackElement(LandmarkId landmark, const TrackElement& observation, Map& map);

/// Returns the ray of the second frame that shows exactly what a keypoint of the first frame shows,
/// if the camera only turned between them, or std::nullopt if the patches do not fit or are
/// missing.
std::optional<Eigen::Vector2d> AlignRotatedMatch(const Frame& first, const Frame& second,
                                                 const orb::Match& match,
                                                 const SO3& second_from_first,
                                                 const MeasurementModel& model);

/// Applies AlignKeypoint to every keypoint of a frame that observes a landmark.
void AlignKeypoints(const Map& map, Frame& frame);

}  // namespace corvo
