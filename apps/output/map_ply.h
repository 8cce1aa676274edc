// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/output/landmark_spool.h"
#include "vo/map/map.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// Returns a map as an ASCII PLY point cloud in world coordinates: the removed landmarks and then
/// the landmarks of the map in order of their ids, gray, followed by the camera centers of the
/// keyframes, red. Each point has the index of its segment. Coordinates are multiplied by
/// `meters_per_unit`.
std::string MapPly(const LandmarkSpool& finished, const Map& map, double meters_per_unit = 1);

/// Returns the point cloud of a refined sequence in the same format: its landmarks, then its
/// keyframes in the order of frames.
std::string MapPly(const Refinement& refinement, double meters_per_unit = 1);

}  // namespace corvo
