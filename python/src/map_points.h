// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "apps/output/final_map.h"

namespace corvo::python {

/// The landmarks of a map, with equal indices.
struct MapPoints {
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> segments;
  std::vector<double> positions;  ///< x, y, z of each.
};

inline MapPoints ToMapPoints(const std::vector<MapPoint>& points) {
  MapPoints arrays;
  for (const MapPoint& point : points) {
    arrays.ids.push_back(point.id);
    arrays.segments.push_back(point.segment);
    arrays.positions.insert(arrays.positions.end(), point.in_world.begin(), point.in_world.end());
  }
  return arrays;
}

}  // namespace corvo::python
