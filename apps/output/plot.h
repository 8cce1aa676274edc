// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// The content of a trajectory plot, all in one world frame.
struct TrajectoryPlot {
  std::vector<PoseSequence> segments;  ///< The estimate, one color per segment.
  PoseSequence truth;                  ///< Empty if there is none.
};

/// Returns the gnuplot script that writes the plot as PNG to standard output: the path from above
/// (x and z; other axes if the y axis is not vertical), and the third axis over time.
std::string PlotScript(const TrajectoryPlot& plot);

/// Returns the poses in another world frame.
PoseSequence MovePoses(const Sim3& target_from_world, PoseSequence poses);

/// Draws the plot with gnuplot. Returns false and leaves no file if gnuplot is missing or fails.
bool DrawTrajectory(const TrajectoryPlot& plot, const std::filesystem::path& png);

}  // namespace corvo
