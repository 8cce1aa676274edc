// SPDX-License-Identifier: MIT
#include "apps/run/metric_result.h"

#include <utility>

#include <fmt/format.h>

#include "apps/output/calibration_report.h"
#include "apps/output/final_map.h"
#include "apps/run/known_length_arguments.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the landmarks of a record in the unit of the odometry.
std::vector<MapPoint> PointsInUnits(const RunRecord& record) {
  return record.is_refined() ? CollectPoints(*record.refinement)
                             : CollectPoints(*record.finished, record.odometry.map());
}

std::vector<PointInSegment> PositionsOf(const std::vector<MapPoint>& points) {
  std::vector<PointInSegment> positions;
  for (const MapPoint& point : points) positions.push_back({point.segment, point.in_world});
  return positions;
}

MetricScale ScaleOfKnownLengths(const RunArguments& arguments, const RunRecord& record) {
  const Trajectory& trajectory = record.trajectory;
  const Camera camera(ReportCalibration(record.odometry, record.refinement).camera);
  std::vector<ScaleMeasurement> measurements;
  for (const std::string& text : arguments.known_distances) {
    measurements.push_back(MeasureScale(trajectory, ParseKnownDistance(text)));
  }
  for (const std::string& text : arguments.known_sizes) {
    measurements.push_back(MeasureScale(trajectory, camera, ParseKnownSize(text)));
  }
  return InterpolateScale(
      trajectory, measurements,
      arguments.known_sizes.empty() ? ScaleSource::kKnownDistance : ScaleSource::kKnownSize);
}

MetricScale FindScale(const RunArguments& arguments, const RunRecord& record) {
  const Trajectory& trajectory = record.trajectory;
  if (arguments.camera_height_m) {
    return ScaleOfCameraHeight(trajectory, PositionsOf(PointsInUnits(record)),
                               *arguments.camera_height_m);
  }
  if (arguments.meters_per_unit) return ConstantScale(trajectory, *arguments.meters_per_unit);
  return ScaleOfKnownLengths(arguments, record);
}

/// Returns the segments that have no scale.
std::string WhyNotMetric(const Trajectory& trajectory, const MetricScale& scale) {
  std::string names;
  for (const Segment& segment : trajectory.Segments()) {
    if (scale.frames[segment.first_frame]) continue;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", segment.index);
  }
  if (names.empty()) return "";
  return fmt::format("the lengths of segment {} are not in meters: {}", names,
                     scale.source == ScaleSource::kCameraHeight
                         ? "no ground was found below the path of the camera"
                         : "the known lengths are in other segments");
}

}  // namespace

void BringToMeters(const RunArguments& arguments, RunRecord& record) {
  if (!arguments.IsMetric()) return;
  try {
    record.metric.emplace(record.trajectory, FindScale(arguments, record));
  } catch (const Error& error) {
    record.why_not_metric = error.what();
    return;
  }
  record.trajectory = record.metric->Apply(std::move(record.trajectory));
  record.why_not_metric = WhyNotMetric(record.trajectory, record.metric->scale());
}

std::vector<double> MetersPerUnit(const RunRecord& record) {
  if (record.metric) return record.metric->MetersPerUnit();
  return std::vector<double>(record.trajectory.frames.size(), 1);
}

std::vector<MapPoint> PointsOf(const RunRecord& record) {
  std::vector<MapPoint> points = PointsInUnits(record);
  if (!record.metric) return points;
  for (MapPoint& point : points) {
    point.in_world = record.metric->ToMeters({point.segment, point.in_world});
  }
  return points;
}

std::string MetricScaleTable(const MetricScale& scale) {
  std::string table = "index,meters_per_unit,log_sigma\n";
  for (std::size_t i = 0; i < scale.frames.size(); ++i) {
    if (!scale.frames[i]) continue;
    table += fmt::format("{},{:.9g},{:.6g}\n", i, scale.frames[i]->meters_per_unit,
                         scale.frames[i]->log_sigma);
  }
  return table;
}

}  // namespace corvo
