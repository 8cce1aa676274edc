// SPDX-License-Identifier: MIT
#include "apps/run/run_plot.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "apps/output/evaluation_report.h"
#include "apps/output/segment_report.h"
#include "vo/evaluation/evaluation.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

std::string Title(const RunArguments& arguments, const RunInputs& inputs,
                  const RunSummary& summary) {
  const bool is_kitti = inputs.source.list().layout == "kitti";
  std::string title = fmt::format(
      "{}{}: {} of {} frames posed", is_kitti ? "KITTI " : "",
      inputs.source.is_live() ? arguments.input.string() : SequenceName(arguments.input),
      summary.num_posed, summary.num_frames);
  if (summary.segments.size() > 1) title += fmt::format(", {} segments", summary.segments.size());
  if (summary.evaluation) title += ", " + AteText(*summary.evaluation);
  return title;
}

/// Returns the pairs of frames that have one of the poses.
std::vector<PosePair> PairsOf(const PoseSequence& poses, const std::vector<PosePair>& pairs) {
  std::vector<PosePair> selected;
  for (const PosePair& pair : pairs) {
    if (std::ranges::binary_search(poses, pair.time_ns, {}, &TimedPose::time_ns)) {
      selected.push_back(pair);
    }
  }
  return selected;
}

/// Returns the estimate of every segment, in its own gauge.
std::vector<PlottedEstimate> Estimates(const Trajectory& trajectory) {
  const std::vector<Segment> segments = trajectory.Segments();
  std::vector<PlottedEstimate> estimates;
  for (const Segment& segment : segments) {
    const std::string name =
        segments.size() == 1 ? "estimate" : fmt::format("segment {}", segment.index);
    estimates.push_back({name, PosesOf(segment, trajectory), {}});
  }
  return estimates;
}

bool IsGeneric(const std::string& name) {
  constexpr std::array<std::string_view, 14> kNames = {"",
                                                       ".",
                                                       "mav0",
                                                       "cam0",
                                                       "data",
                                                       "images",
                                                       "rgb",
                                                       "image_0",
                                                       "dso",
                                                       "data.csv",
                                                       "state_groundtruth_estimate0",
                                                       "groundtruth.txt",
                                                       "groundtruth.tum",
                                                       "trajectory.tum"};
  return std::ranges::count(kNames, name) > 0 || name.find_first_of("*?[") != std::string::npos;
}

}  // namespace

std::string SequenceName(const fs::path& input) {
  fs::path path = fs::absolute(input).lexically_normal();
  while (path.has_relative_path() && IsGeneric(path.filename().string())) path = path.parent_path();
  return path.has_relative_path() ? path.filename().string() : input.string();
}

TrajectoryPlot MakeRunPlot(const RunArguments& arguments, const RunInputs& inputs,
                           const RunRecord& record, const RunSummary& summary) {
  TrajectoryPlot plot;
  plot.title = Title(arguments, inputs, summary);
  plot.estimates = Estimates(record.trajectory);
  if (record.metric || summary.evaluation) plot.unit = std::string("m");
  if (!summary.evaluation) return plot;
  plot.ate_rmse = summary.evaluation->absolute.rmse;
  for (PlottedEstimate& estimate : plot.estimates) {
    estimate.pairs = PairsOf(estimate.poses, summary.evaluation->aligned_pairs);
    estimate.poses = MovePoses(summary.evaluation->truth_from_estimate, std::move(estimate.poses));
  }
  const std::vector<FrameResult>& frames = record.trajectory.frames;
  for (const TimedPose& pose : inputs.truth.poses) {
    const bool is_within =
        pose.time_ns >= frames.front().time_ns && pose.time_ns <= frames.back().time_ns;
    if (is_within) plot.truth.push_back(pose);
  }
  return plot;
}

}  // namespace corvo
