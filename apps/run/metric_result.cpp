// SPDX-License-Identifier: MIT
#include "apps/run/metric_result.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "apps/output/final_map.h"
#include "orb/error.h"
#include "vo/io/text_lines.h"

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

MetricScale MeasureScale(const RunArguments& arguments, const RunRecord& record) {
  const Trajectory& trajectory = record.trajectory;
  if (arguments.camera_height_m) {
    return ScaleOfCameraHeight(trajectory, PositionsOf(PointsInUnits(record)),
                               *arguments.camera_height_m);
  }
  if (!arguments.known_distance.empty()) {
    return ScaleOfDistance(trajectory, ParseKnownDistance(arguments.known_distance));
  }
  return ConstantScale(trajectory, *arguments.meters_per_unit);
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
                         : "the known distance is in another segment");
}

}  // namespace

KnownDistance ParseKnownDistance(const std::string& text) {
  const std::vector<std::string> fields = SplitFields(text);
  constexpr double kMaxFrame = 1e9;
  const auto parse = [&](std::size_t i, double min, double max) {
    const double value = ParseNumber(fields[i], "--known-distance: ");
    CheckRange("--known-distance", value, min, max);
    return value;
  };
  if (fields.size() != 3) {
    throw Error(fmt::format("--known-distance: '{}' is not FRAME,FRAME,METERS", text));
  }
  return {static_cast<int>(std::lround(parse(0, 0, kMaxFrame))),
          static_cast<int>(std::lround(parse(1, 0, kMaxFrame))), parse(2, 1e-9, 1e9)};
}

void BringToMeters(const RunArguments& arguments, RunRecord& record) {
  if (!arguments.IsMetric()) return;
  try {
    record.metric.emplace(record.trajectory, MeasureScale(arguments, record));
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
