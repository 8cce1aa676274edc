// SPDX-License-Identifier: MIT
#include "apps/output/plot.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "apps/output/gnuplot.h"

namespace corvo {
namespace {

constexpr std::array<char, 3> kAxisNames = {'x', 'y', 'z'};

/// The world axes of the plot: horizontal, vertical, and the axis perpendicular to both.
struct Axes {
  int across = 0;
  int up = 2;
  int other = 1;
};

Eigen::AlignedBox3d BoundingBox(const PoseSequence& poses) {
  Eigen::AlignedBox3d box;
  for (const TimedPose& pose : poses) box.extend(pose.world_from_camera.translation());
  return box;
}

/// Returns the bounding box of all poses in the plot.
Eigen::AlignedBox3d BoundingBox(const TrajectoryPlot& plot) {
  Eigen::AlignedBox3d box = BoundingBox(plot.truth);
  for (const PoseSequence& segment : plot.segments) box.extend(BoundingBox(segment));
  return box.isEmpty() ? Eigen::AlignedBox3d(Eigen::Vector3d::Zero()) : box;
}

/// Returns the axes of a view from above. They are those of a camera (x across, z up) unless the
/// path extends clearly further along y than along x or z, as in worlds whose z axis points up.
Axes ChooseAxes(const Eigen::Vector3d& extent) {
  if (extent.y() <= 2 * std::min(extent.x(), extent.z())) return {0, 2, 1};
  return extent.z() <= extent.x() ? Axes{0, 1, 2} : Axes{1, 2, 0};
}

/// Returns ranges of the same length for both axes, so that a straight path does not squeeze the
/// plot.
std::string EqualRanges(const Eigen::AlignedBox3d& box, const Axes& axes) {
  const Eigen::Vector3d middle = box.center();
  const Eigen::Vector3d extent = box.sizes();
  const double half = 0.55 * std::max({extent[axes.across], extent[axes.up], 1e-6});
  return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
                     middle[axes.across] - half, middle[axes.across] + half, middle[axes.up] - half,
                     middle[axes.up] + half);
}

TimeNs StartTime(const TrajectoryPlot& plot) {
  for (const PoseSequence& segment : plot.segments) {
    if (!segment.empty()) return segment.front().time_ns;
  }
  return plot.truth.empty() ? 0 : plot.truth.front().time_ns;
}

/// Returns a named gnuplot data block with the columns across, up, other, time since `start_ns` in
/// s.
std::string DataBlock(const std::string& name, const PoseSequence& poses, const Axes& axes,
                      TimeNs start_ns) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d& position = pose.world_from_camera.translation();
    block += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}\n", position[axes.across], position[axes.up],
                         position[axes.other], ToSeconds(pose.time_ns - start_ns));
  }
  return block + "EOD\n";
}

/// A curve of the plot: its data block, legend and gnuplot style.
struct Curve {
  std::string block;
  std::string title;
  std::string style;
};

std::vector<Curve> Curves(const TrajectoryPlot& plot) {
  std::vector<Curve> curves;
  if (!plot.truth.empty()) curves.push_back({"truth", "ground truth", "lw 3 lc rgb '#b0b0b0'"});
  const bool several = plot.segments.size() > 1;
  for (std::size_t i = 0; i < plot.segments.size(); ++i) {
    curves.push_back({fmt::format("segment{}", i),
                      several ? fmt::format("estimate, segment {}", i) : "estimate",
                      fmt::format("lw 2 lt {}", i + 1)});
  }
  return curves;
}

/// Returns the gnuplot command that plots two columns of every curve.
std::string PlotCommand(const std::vector<Curve>& curves, const char* columns) {
  std::string command = "plot ";
  for (const Curve& curve : curves) {
    command += fmt::format("${} using {} with lines title '{}' {}, ", curve.block, columns,
                           curve.title, curve.style);
  }
  return command;
}

std::string PathPanel(const std::vector<Curve>& curves, const Axes& axes,
                      const Eigen::AlignedBox3d& box) {
  return EqualRanges(box, axes) +
         fmt::format(
             "set size ratio -1\nset key outside top center horizontal\n"
             "set xlabel '{}'\nset ylabel '{}'\n",
             kAxisNames[axes.across], kAxisNames[axes.up]) +
         PlotCommand(curves, "1:2") +
         fmt::format(
             "${} every ::0::0 using 1:2 with points pt 7 ps 2 lc rgb 'black' "
             "title 'start'\n",
             curves.back().block);
}

std::string HeightPanel(const std::vector<Curve>& curves, const Axes& axes) {
  return fmt::format("set size noratio\nset autoscale\nset xlabel 'time [s]'\nset ylabel '{}'\n",
                     kAxisNames[axes.other]) +
         PlotCommand(curves, "4:3") + "\n";
}

}  // namespace

std::string PlotScript(const TrajectoryPlot& plot) {
  const Eigen::AlignedBox3d box = BoundingBox(plot);
  const Axes axes = ChooseAxes(box.sizes());
  const TimeNs start_ns = StartTime(plot);
  std::string script = "set terminal pngcairo size 1400,700\nset grid\n";
  if (!plot.truth.empty()) script += DataBlock("truth", plot.truth, axes, start_ns);
  for (std::size_t i = 0; i < plot.segments.size(); ++i) {
    script += DataBlock(fmt::format("segment{}", i), plot.segments[i], axes, start_ns);
  }
  const std::vector<Curve> curves = Curves(plot);
  if (curves.empty()) return script + "set yrange [-1:1]\nplot [-1:1] NaN title 'no pose'\n";
  return script + "set multiplot layout 1,2\n" + PathPanel(curves, axes, box) +
         HeightPanel(curves, axes) + "unset multiplot\n";
}

PoseSequence MovePoses(const Sim3& target_from_world, PoseSequence poses) {
  for (TimedPose& pose : poses) {
    pose.world_from_camera = TransformPose(target_from_world, pose.world_from_camera);
  }
  return poses;
}

bool DrawTrajectory(const TrajectoryPlot& plot, const std::filesystem::path& png) {
  return RunGnuplot(PlotScript(plot), png);
}

}  // namespace corvo
