// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/output/landmark_spool.h"
#include "vo/map/map.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// A map as an ASCII PLY point cloud, in world coordinates: landmarks, gray, those that have left
/// it first, then the others in id order; then the centers of the keyframes' cameras, red. Each
/// point carries its segment. A unit of the map is `meters_per_unit` in the file.
std::string MapPly(const LandmarkSpool& finished, const Map& map, double meters_per_unit = 1);

/// The same of a refined sequence: its landmarks in id order, its keyframes in the order of frames.
std::string MapPly(const Refinement& refinement, double meters_per_unit = 1);

}  // namespace corvo
