// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"

namespace corvo {

/// A landmark of a finished run.
struct MapPoint {
  LandmarkId id = kNoId;
  int segment = 0;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> rgb = {160, 160, 160};
  int num_observations = 0;  ///< Number of frames whose observations were recorded.
};

/// Returns points as a binary PLY point cloud (little-endian): double x, y, z; uchar red, green,
/// blue; int id, segment, observations.
std::string ToPly(const std::vector<MapPoint>& points);

/// Reads the points of ToPly(). Throws corvo::Error if `file` cannot be read or is not such a file.
std::vector<MapPoint> ReadMapPly(const std::filesystem::path& file);

}  // namespace corvo
