// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/output/landmark_spool.h"
#include "apps/output/map_ply.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// Returns the landmarks of a finished run: those that were marginalized, in the order of that,
/// then those of the map in the order of their ids. Landmarks of a map that the odometry discarded
/// are left out.
std::vector<MapPoint> CollectPoints(const LandmarkSpool& marginalized, const Map& map);

/// Returns the landmarks of a refined run.
std::vector<MapPoint> CollectPoints(const Refinement& refinement);

/// Writes the observations of `points` in all posed frames (observations.npy) and counts them in
/// the points. `log` must have recorded the odometry from its first image on. Throws corvo::Error
/// if the file cannot be written.
void WriteObservations(const Odometry& odometry, const ObservationLog& log,
                       const std::filesystem::path& file, std::vector<MapPoint>& points);

}  // namespace corvo
