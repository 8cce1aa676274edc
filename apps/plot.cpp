#include "apps/plot.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "apps/gnuplot.h"

namespace corvo {
namespace {

constexpr std::array<char, 3> kAxisNames = {'x', 'y', 'z'};

/// Which world axis goes where.
struct Axes {
  int across = 0;
  int up = 2;
  int other = 1;
};

/// Leaves out the axis of least extent; top view (x across, z up) where nothing moves.
Axes ChooseAxes(const PoseSequence& poses) {
  Eigen::AlignedBox3d box;
  for (const TimedPose& pose : poses) box.extend(pose.world_from_camera.translation());
  if (box.isEmpty()) return {};
  const Eigen::Vector3d extent = box.sizes();
  if (extent.y() <= extent.x() && extent.y() <= extent.z()) return {0, 2, 1};
  if (extent.z() <= extent.x()) return {0, 1, 2};
  return {1, 2, 0};
}

PoseSequence Concatenate(const std::vector<PoseSequence>& segments) {
  PoseSequence all;
  for (const PoseSequence& segment : segments)
    all.insert(all.end(), segment.begin(), segment.end());
  return all;
}

TimeNs StartTime(const TrajectoryPlot& plot) {
  for (const PoseSequence& segment : plot.segments) {
    if (!segment.empty()) return segment.front().time_ns;
  }
  return plot.truth.empty() ? 0 : plot.truth.front().time_ns;
}

/// A named gnuplot data block with the columns across, up, other, time since `start_ns` in s.
std::string DataBlock(const std::string& name, const PoseSequence& poses, const Axes& axes,
                      TimeNs start_ns) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d& position = pose.world_from_camera.translation();
    block += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}\n", position[axes.across], position[axes.up],
                         position[axes.other], 1e-9 * static_cast<double>(pose.time_ns - start_ns));
  }
  return block + "EOD\n";
}

/// A curve of the picture: its data block, legend and gnuplot style.
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

/// "plot ..." of two columns of every curve.
std::string PlotCommand(const std::vector<Curve>& curves, const char* columns) {
  std::string command = "plot ";
  for (const Curve& curve : curves) {
    command += fmt::format("${} using {} with lines title '{}' {}, ", curve.block, columns,
                           curve.title, curve.style);
  }
  return command;
}

std::string PathPanel(const std::vector<Curve>& curves, const Axes& axes) {
  return fmt::format(
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
  return fmt::format("set size noratio\nset xlabel 'time [s]'\nset ylabel '{}'\n",
                     kAxisNames[axes.other]) +
         PlotCommand(curves, "4:3") + "\n";
}

}  // namespace

std::string PlotScript(const TrajectoryPlot& plot) {
  const Axes axes = ChooseAxes(plot.truth.empty() ? Concatenate(plot.segments) : plot.truth);
  const TimeNs start_ns = StartTime(plot);
  std::string script = "set terminal pngcairo size 1400,700\nset grid\n";
  if (!plot.truth.empty()) script += DataBlock("truth", plot.truth, axes, start_ns);
  for (std::size_t i = 0; i < plot.segments.size(); ++i) {
    script += DataBlock(fmt::format("segment{}", i), plot.segments[i], axes, start_ns);
  }
  const std::vector<Curve> curves = Curves(plot);
  if (curves.empty()) return script + "set yrange [-1:1]\nplot [-1:1] NaN title 'no pose'\n";
  return script + "set multiplot layout 1,2\n" + PathPanel(curves, axes) +
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
