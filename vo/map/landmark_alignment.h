// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// Moves keypoint `k` of a frame whose pose is nearly known to where it sees exactly what the
/// landmark's reference sees: corners are found to about a pixel of their level, and what differs
/// from frame to frame would bias the scale of the map. The reference's patch is taken as a plane
/// parallel to its image. Returns false, and leaves the keypoint, where the patches do not fit or
/// there are none.
bool AlignKeypoint(const Map& map, const Landmark& landmark, Frame& frame, int k);

/// AlignKeypoint for an observation of the map.
bool AlignTrackElement(LandmarkId landmark, const TrackElement& observation, Map& map);

/// The ray by which the second of two frames shows exactly what a keypoint of the first sees, where
/// between them the camera only turned. None where the patches do not fit or there are none.
std::optional<Eigen::Vector2d> AlignRotatedMatch(const Frame& first, const Frame& second,
                                                 const orb::Match& match,
                                                 const SO3& second_from_first,
                                                 const MeasurementModel& model);

/// AlignKeypoint for every keypoint of a frame that sees a landmark.
void AlignKeypoints(const Map& map, Frame& frame);

}  // namespace corvo
