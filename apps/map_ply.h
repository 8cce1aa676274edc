#pragma once

#include <string>

#include "vo/map.h"

namespace corvo {

/// The map as an ASCII PLY point cloud, in world coordinates: landmarks in id order, grey, then the
/// centres of the keyframes' cameras, red. Each point carries its segment.
std::string MapPly(const Map& map);

}  // namespace corvo
