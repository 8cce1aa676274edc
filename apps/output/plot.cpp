// SPDX-License-Identifier: MIT
#include "apps/output/plot.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "apps/output/gnuplot.h"
#include "apps/output/printable.h"
#include "apps/output/vertical_axis.h"

namespace corvo {
namespace {

constexpr std::array<char, 3> kAxisNames = {'x', 'y', 'z'};
constexpr std::size_t kMaxNames = 6;  // Further curves have no entry in the legend.

/// Colors and dashes that readers with any color vision tell apart (Okabe and Ito, "Color universal
/// design", 2008).
constexpr std::array<const char*, 6> kColors = {"#0072B2", "#D55E00", "#009E73",
                                                "#CC79A7", "#E69F00", "#56B4E9"};

/// Returns a gnuplot string that is drawn as the text.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : Printable(text, true)) {
    quoted += c;
    if (c == '\'') quoted += c;
  }
  return quoted + "'";
}

/// Returns the bounding box of all poses in the plot.
Eigen::AlignedBox3d BoundingBox(const TrajectoryPlot& plot) {
  Eigen::AlignedBox3d box;
  const auto extend = [&box](const PoseSequence& poses) {
    for (const TimedPose& pose : poses) box.extend(pose.world_from_camera.translation());
  };
  extend(plot.truth);
  for (const PlottedEstimate& estimate : plot.estimates) extend(estimate.poses);
  return box.isEmpty() ? Eigen::AlignedBox3d(Eigen::Vector3d::Zero()) : box;
}

/// Returns the axes of the world that the estimates have been moved to.
VerticalAxis AxesOf(const TrajectoryPlot& plot) {
  if (HasRotations(plot.truth)) return FindVerticalAxis(plot.truth);
  PoseSequence poses;
  for (const PlottedEstimate& estimate : plot.estimates) {
    poses.insert(poses.end(), estimate.poses.begin(), estimate.poses.end());
  }
  return FindVerticalAxis(poses);
}

/// Returns ranges of the same length for both axes, so that a straight path does not squeeze the
/// plot.
std::string EqualRanges(const Eigen::AlignedBox3d& box, const VerticalAxis& axes) {
  const Eigen::Vector3d middle = box.center();
  const Eigen::Vector3d extent = box.sizes();
  const double half = 0.55 * std::max({extent[axes.across], extent[axes.along], 1e-6});
  return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
                     middle[axes.across] - half, middle[axes.across] + half,
                     middle[axes.along] - half, middle[axes.along] + half);
}

TimeNs StartTime(const TrajectoryPlot& plot) {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (const PlottedEstimate& estimate : plot.estimates) {
    if (!estimate.poses.empty()) start_ns = std::min(start_ns, estimate.poses.front().time_ns);
  }
  if (!plot.truth.empty()) start_ns = std::min(start_ns, plot.truth.front().time_ns);
  return start_ns;
}

/// Returns a named gnuplot data block with one line for each item, which has a time. A blank line,
/// which interrupts the curve, is where more than two items are missing. An item alone is repeated,
/// so that it is drawn as a dot.
template <typename Item, typename ToLine>
std::string DataBlock(const std::string& name, const std::vector<Item>& items, ToLine&& to_line) {
  PoseSequence times;
  for (const Item& item : items) times.push_back({item.time_ns, SE3()});
  const TimeNs largest_step_ns = 7 * HalfFrame(times);
  std::string block = fmt::format("${} << EOD\n", name);
  const auto is_gap_before = [&](std::size_t i) {
    return i == 0 || i == items.size() || items[i].time_ns - items[i - 1].time_ns > largest_step_ns;
  };
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0 && is_gap_before(i)) block += "\n";
    const std::string line = to_line(items[i]);
    block += line;
    if (is_gap_before(i) && is_gap_before(i + 1)) block += line;
  }
  return block + "EOD\n";
}

/// Returns the data block of poses with the columns across, along, height, seconds.
std::string PoseBlock(const std::string& name, const PoseSequence& poses, const VerticalAxis& axes,
                      TimeNs start_ns) {
  return DataBlock(name, poses, [&](const TimedPose& pose) {
    const Eigen::Vector3d& position = pose.world_from_camera.translation();
    return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}\n", position[axes.across], position[axes.along],
                       axes.sign * position[axes.up], ToSeconds(pose.time_ns - start_ns));
  });
}

/// Returns the data block of position errors with the columns seconds, error.
std::string ErrorBlock(const std::string& name, const std::vector<PosePair>& pairs,
                       TimeNs start_ns) {
  return DataBlock(name, pairs, [&](const PosePair& pair) {
    return fmt::format("{:.6f} {:.6g}\n", ToSeconds(pair.time_ns - start_ns),
                       PositionErrors({pair}).front());
  });
}

/// A curve of the plot: its data block, legend (empty for none) and gnuplot style.
struct Curve {
  std::string block;
  std::string legend;
  std::string style;
};

std::string ColorOf(std::size_t estimate) {
  const std::size_t round = estimate / kColors.size();
  const std::string dashes = round == 0 ? "" : fmt::format(" dt {}", 2 + (round - 1) % 4);
  return fmt::format("lw 1.8 lc rgb '{}'{}", kColors[estimate % kColors.size()], dashes);
}

/// Returns the end of a name that is too long for the legend.
std::string Shortened(const std::string& name) {
  constexpr std::size_t kMaxLength = 48;
  return name.size() <= kMaxLength ? name : "..." + name.substr(name.size() - kMaxLength + 3);
}

std::string LegendOf(const TrajectoryPlot& plot, std::size_t estimate) {
  const std::size_t count = plot.estimates.size();
  if (count <= kMaxNames || estimate + 1 < kMaxNames)
    return Shortened(plot.estimates[estimate].name);
  return estimate + 1 == kMaxNames ? fmt::format("and {} more", count - kMaxNames + 1) : "";
}

std::vector<Curve> Curves(const TrajectoryPlot& plot) {
  std::vector<Curve> curves;
  if (!plot.truth.empty()) curves.push_back({"truth", "ground truth", "lw 4 lc rgb '#B8B8B8'"});
  for (std::size_t i = 0; i < plot.estimates.size(); ++i) {
    curves.push_back({fmt::format("estimate{}", i), LegendOf(plot, i), ColorOf(i)});
  }
  return curves;
}

std::vector<Curve> ErrorCurves(const TrajectoryPlot& plot) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < plot.estimates.size(); ++i) {
    if (plot.estimates[i].pairs.empty()) continue;
    curves.push_back({fmt::format("error{}", i), "", ColorOf(i)});
  }
  return curves;
}

/// Returns the gnuplot command that plots two columns of every curve.
std::string PlotCommand(const std::vector<Curve>& curves, const char* columns) {
  std::string command = "plot ";
  for (const Curve& curve : curves) {
    command += fmt::format("${} using {} with lines {}, ", curve.block, columns, curve.style);
  }
  return command;
}

/// Returns the command that places the next panel; the numbers are shares of the figure.
std::string Place(double left, double right, double bottom, double top) {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
      "set tmargin at screen {}\n",
      left, right, bottom, top);
}

/// Returns the commands for the title and the legend, in a panel of the figure's width, which the
/// entries share.
std::string LegendPanel(const TrajectoryPlot& plot, const std::vector<Curve>& curves) {
  std::string entries;
  for (const Curve& curve : curves) {
    if (curve.legend.empty()) continue;
    entries += fmt::format("NaN with lines title {} {}, ", Quoted(curve.legend), curve.style);
  }
  return Place(0.02, 0.98, 0.86, 0.953) +
         fmt::format("set label 1 {} at screen 0.5,0.97 center\n", Quoted(plot.title)) +
         "unset border\nunset tics\nset key inside center top horizontal Left reverse\n"
         "plot [0:1] [0:1] " +
         entries +
         "NaN with points pt 7 lc rgb 'black' title 'start'\n"
         "unset label 1\nset key off\nset border 3\nset xtics nomirror\nset ytics nomirror\n"
         "set grid lt 1 lw 0.5 lc rgb '#DDDDDD'\n";
}

std::string PathPanel(const TrajectoryPlot& plot, const std::vector<Curve>& curves,
                      const VerticalAxis& axes) {
  return Place(0.07, 0.485, 0.1, 0.85) + EqualRanges(BoundingBox(plot), axes) +
         fmt::format(
             "set size ratio -1\n"
             "set xlabel '{} [{}]'\nset ylabel '{} [{}]'\n",
             kAxisNames[axes.across], plot.unit, kAxisNames[axes.along], plot.unit) +
         PlotCommand(curves, "1:2") +
         fmt::format(
             "${} every ::0:0:0:0 using 1:2 with points pt 7 lc rgb 'black'\n"
             "set size noratio\nset autoscale\n",
             plot.estimates.empty() ? "truth" : "estimate0");
}

std::string TimeLabel(const TrajectoryPlot& plot) {
  return plot.has_times ? "set xlabel 'time [s]'\n" : "set xlabel 'row'\n";
}

std::string HeightPanel(const TrajectoryPlot& plot, const std::vector<Curve>& curves,
                        bool has_errors) {
  return Place(0.57, 0.95, has_errors ? 0.53 : 0.1, 0.85) +
         (has_errors ? "set format x ''\nunset xlabel\n" : TimeLabel(plot)) +
         fmt::format("set ylabel 'height [{}]'\n", plot.unit) + PlotCommand(curves, "4:3") + "\n";
}

/// Returns the commands for the panel of errors, which has the range of times of the one above.
std::string ErrorPanel(const TrajectoryPlot& plot) {
  std::string rmse, label;
  if (plot.ate_rmse) {
    rmse = fmt::format("{:.6g} with lines lw 1.2 dt 2 lc rgb '#555555'", *plot.ate_rmse);
    label = fmt::format("set label 2 'rmse' at graph 1.01, first {:.6g}\n", *plot.ate_rmse);
  }
  return Place(0.57, 0.95, 0.1, 0.47) + "set format x\nset xrange [GPVAL_X_MIN:GPVAL_X_MAX]\n" +
         "set yrange [0:*]\n" + TimeLabel(plot) +
         fmt::format("set ylabel 'error [{}]'\n", plot.unit) + label +
         PlotCommand(ErrorCurves(plot), "1:2") + rmse + "\n";
}

std::string DataBlocks(const TrajectoryPlot& plot, const VerticalAxis& axes) {
  const TimeNs start_ns = StartTime(plot);
  std::string blocks;
  if (!plot.truth.empty()) blocks += PoseBlock("truth", plot.truth, axes, start_ns);
  for (std::size_t i = 0; i < plot.estimates.size(); ++i) {
    const PlottedEstimate& estimate = plot.estimates[i];
    blocks += PoseBlock(fmt::format("estimate{}", i), estimate.poses, axes, start_ns);
    if (estimate.pairs.empty()) continue;
    blocks += ErrorBlock(fmt::format("error{}", i), estimate.pairs, start_ns);
  }
  return blocks;
}

}  // namespace

std::string PlotScript(const TrajectoryPlot& plot, PlotFormat format) {
  std::string script = TerminalCommand(format) + "set encoding utf8\n";
  const std::vector<Curve> curves = Curves(plot);
  if (curves.empty()) {
    return script + fmt::format("set title {}\n", Quoted(plot.title)) +
           "set yrange [-1:1]\nplot [-1:1] NaN title 'no pose'\n";
  }
  const VerticalAxis axes = AxesOf(plot);
  const bool has_errors = !ErrorCurves(plot).empty();
  script += DataBlocks(plot, axes);
  script += "set multiplot\n" + LegendPanel(plot, curves) + PathPanel(plot, curves, axes);
  script += HeightPanel(plot, curves, has_errors);
  if (has_errors) script += ErrorPanel(plot);
  return script + "unset multiplot\n";
}

PoseSequence MovePoses(const Sim3& target_from_world, PoseSequence poses) {
  for (TimedPose& pose : poses) {
    pose.world_from_camera = TransformPose(target_from_world, pose.world_from_camera);
  }
  return poses;
}

bool DrawTrajectory(const TrajectoryPlot& plot, const std::filesystem::path& file) {
  return RunGnuplot(PlotScript(plot, ParsePlotFormat("plot", file)), file);
}

}  // namespace corvo
