// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// What an image of a trajectory shows, all in one world frame.
struct TrajectoryPlot {
  std::vector<PoseSequence> segments;  ///< The estimate; each in a color of its own.
  PoseSequence truth;                  ///< Empty if there is none.
};

/// The gnuplot script that writes the image, as PNG, to standard output: the path from above
/// (x and z; other axes in worlds whose y axis is not the vertical), and the third axis over time.
std::string PlotScript(const TrajectoryPlot& plot);

/// The poses, moved into another world.
PoseSequence MovePoses(const Sim3& target_from_world, PoseSequence poses);

/// Draws with gnuplot. False, with no file left, where gnuplot is missing or fails.
bool DrawTrajectory(const TrajectoryPlot& plot, const std::filesystem::path& png);

}  // namespace corvo
