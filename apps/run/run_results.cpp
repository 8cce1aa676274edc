// SPDX-License-Identifier: MIT
#include "apps/run/run_results.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/output/environment.h"
#include "apps/output/final_map.h"
#include "apps/output/image_file.h"
#include "apps/output/json_text.h"
#include "apps/output/plot_file.h"
#include "apps/output/segment_report.h"
#include "apps/run/kitti_trajectory.h"
#include "apps/run/metric_result.h"
#include "apps/run/run_plot.h"
#include "apps/run/trajectory_file.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/io/pose_graph_io.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

PoseSequence PosedKeyframes(const Trajectory& trajectory) {
  Trajectory keyframes;
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.is_keyframe) keyframes.frames.push_back(frame);
  }
  return keyframes.PosedFrames();
}

constexpr const char* kSegmentPrefix = "trajectory_segment_";
constexpr const char* kSegmentSuffix = ".tum";

/// Writes trajectory.tum and, if there are several segments, each to a file of its own, too.
void WriteSegments(const Trajectory& trajectory, const OutputFolder& output) {
  WriteTrajectory(output.Stage("trajectory.tum"), trajectory);
  const std::vector<Segment> segments = trajectory.Segments();
  if (segments.size() < 2) return;
  for (const Segment& segment : segments) {
    const std::string name = fmt::format("{}{}{}", kSegmentPrefix, segment.index, kSegmentSuffix);
    WriteTumParts(output.Stage(name), {{ToText(segment), PosesOf(segment, trajectory)}});
  }
}

void WriteTrajectories(const Trajectory& trajectory, const OutputFolder& output) {
  const PoseSequence poses = trajectory.PosedFrames();
  WriteSegments(trajectory, output);
  WriteEurocPoses(output.Stage("trajectory_euroc.csv"), poses);
  WriteTum(output.Stage("rotations.tum"), trajectory.Rotations());
  WriteTum(output.Stage("keyframes.tum"), PosedKeyframes(trajectory));
  if (WhyNotKitti(trajectory).empty()) {
    WriteKittiPoses(output.Stage("trajectory.kitti"), KittiRows(trajectory));
  }
}

void WriteTables(const RunRecord& record, const OutputFolder& output) {
  std::vector<MapPoint> points = PointsOf(record);
  WriteObservations(record.odometry, record.observations, output.Stage("observations.npy"), points);
  for (MapPoint& point : points) point.rgb = record.colors.Of(point.id);
  output.Write("map.ply", ToPly(points));
  output.Write("frames.csv", FrameTable(record.trajectory, record.images));
  output.Write("relative_poses.csv", RelativePoseTable(record.trajectory));
  output.Write("pose_graph.g2o", ToG2o(record.graph, G2oForm::kSe3));
  output.Write("pose_graph_sim3.g2o", ToG2o(record.graph, G2oForm::kSim3));
  if (record.features) record.features->Write(record.graph, output.Stage("keyframe_features.npy"));
  output.Write("timing.csv", TimingTable(record.timings));
  if (!record.cameras.empty()) output.Write("camera_history.csv", record.cameras.Table());
  if (record.metric) output.Write("metric_scale.csv", MetricScaleTable(record.metric->scale()));
}

/// Returns the estimated camera, without standard deviations if the images contradict the prior.
CameraFile EstimatedCamera(const CalibrationReport& calibration) {
  CameraFile file{Camera(calibration.camera), {}, "estimated by corvo run", {}};
  if (!calibration.prior_rejected) file.sigma = calibration.sigma;
  return file;
}

/// Writes where the last image was not searched for features, as --mask takes it; nothing if it
/// was searched everywhere.
void WriteMask(const cv::Mat& mask, const OutputFolder& output) {
  if (!mask.empty()) output.Write("mask.png", EncodeImage(mask != 0, ".png"));
}

void WriteJson(const nlohmann::ordered_json& json, const char* name, const OutputFolder& output) {
  output.Write(name, JsonText(json));
}

}  // namespace

OutputPlan PlanOfRun(bool replaces_foreign) {
  OutputPlan plan;
  plan.names = {"trajectory.tum",
                "trajectory.kitti",
                "trajectory_euroc.csv",
                "keyframes.tum",
                "rotations.tum",
                "groundtruth.tum",
                "map.ply",
                "observations.npy",
                "frames.csv",
                "timing.csv",
                "config.yaml",
                "camera_estimated.yaml",
                "camera_history.csv",
                "environment.json",
                "trajectory.png",
                "summary.json",
                "relative_poses.csv",
                "pose_graph.g2o",
                "pose_graph_sim3.g2o",
                "metric_scale.csv",
                "keyframe_features.npy",
                "mask.png"};
  plan.numbered_prefix = kSegmentPrefix;
  plan.numbered_suffix = kSegmentSuffix;
  plan.checkpoint = kCheckpointFolder;
  plan.replaces_foreign = replaces_foreign;
  return plan;
}

void StageResults(const RunArguments& arguments, const RunInputs& inputs, const RunRecord& record,
                  const RunSummary& summary, const OutputFolder& output) {
  WriteTrajectories(record.trajectory, output);
  if (!inputs.truth.poses.empty()) WriteTum(output.Stage("groundtruth.tum"), inputs.truth.poses);
  WriteTables(record, output);
  WriteMask(record.odometry.last_mask(), output);
  output.Write("config.yaml", WriteOptions(inputs.options));
  output.Write("camera_estimated.yaml", WriteCameraFile(EstimatedCamera(summary.calibration)));
  WriteJson(ToJson(arguments, inputs, summary), "summary.json", output);
  nlohmann::ordered_json environment = DescribeEnvironment(arguments.threads, record.elapsed_s);
  if (record.realtime) environment["realtime"] = ToJson(*record.realtime);
  WriteJson(environment, "environment.json", output);
  const TrajectoryPlot plot = MakeRunPlot(arguments, inputs, record, summary);
  if (!DrawTrajectory(plot, output.Stage("trajectory.png"))) WarnOfMissingPlot("trajectory.png");
}

fs::path CommitResults(const RunEnd& end, const fs::path& folder, OutputFolder& output) {
  if (!end.is_complete() && output.HoldsCompleteResult()) {
    output.CommitAsCheckpoint(false);
    return output.checkpoint();
  }
  try {
    output.Commit(end.is_complete());
  } catch (const std::exception& error) {
    if (output.is_torn()) throw;
    output.CommitAsCheckpoint(end.is_complete());
    throw Error(fmt::format("{}; the result of this run is in {}", error.what(),
                            output.checkpoint().string()));
  }
  return folder;
}

}  // namespace corvo
