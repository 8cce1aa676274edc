// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/export/reconstruction.h"

namespace corvo {

/// Returns a binary PLY point cloud (little-endian) as trainers of radiance fields read it: float
/// x, y, z; uchar red, green, blue.
std::string ToPointCloud(const std::vector<ReconstructedPoint>& points,
                         const SO3& cloud_from_world);

}  // namespace corvo
