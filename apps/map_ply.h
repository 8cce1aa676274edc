#pragma once

#include <string>

#include "vo/map.h"

namespace corvo {

/// The map as an ASCII PLY point cloud, in world coordinates: landmarks in id order, grey, then the
/// centres of the keyframes' cameras, red. Each point carries its segment. A unit of the map is
/// `metres_per_unit` in the file.
std::string MapPly(const Map& map, double metres_per_unit = 1);

}  // namespace corvo
