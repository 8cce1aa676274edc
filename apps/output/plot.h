// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/plot_format.h"
#include "vo/core/trajectory.h"
#include "vo/evaluation/evaluation.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// An estimated trajectory of a plot.
struct PlottedEstimate {
  std::string name;
  PoseSequence poses;
  std::vector<PosePair> pairs;  ///< The aligned pairs whose errors are drawn; empty without truth.
};

/// The content of a trajectory plot, all in one world frame.
struct TrajectoryPlot {
  std::string title;
  std::vector<PlottedEstimate> estimates;  ///< Each has a color of its own.
  PoseSequence truth;                      ///< Empty if there is none.
  std::string unit = "map units";          ///< Unit of lengths.
  bool has_times = true;                   ///< False if times are the numbers of rows.
  std::optional<double> ate_rmse;          ///< Drawn as a line in the panel of errors.
};

/// Returns the gnuplot script that writes the plot to standard output: the path from above, the
/// height over time and, if there are pairs, the position error over time. Curves are interrupted
/// where poses are missing. See FindVerticalAxis() on what is above.
std::string PlotScript(const TrajectoryPlot& plot, PlotFormat format = PlotFormat::kPng);

/// Returns the poses in another world frame.
PoseSequence MovePoses(const Sim3& target_from_world, PoseSequence poses);

/// Draws the plot with gnuplot, in the format of the file's extension. Returns false and leaves no
/// file if gnuplot is missing or fails.
bool DrawTrajectory(const TrajectoryPlot& plot, const std::filesystem::path& file);

}  // namespace corvo
