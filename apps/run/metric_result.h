// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/output/map_ply.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"

namespace corvo {

/// Brings the trajectory of a record to meters if --meters-per-unit, --camera-height,
/// --known-distance or --known-size was given. If the scale cannot be determined, it stays as it is
/// and RunRecord::why_not_metric says why.
void BringToMeters(const RunArguments& arguments, RunRecord& record);

/// Returns the meters per unit of a record's odometry by the index of the frame; 1 if the
/// trajectory is not in meters.
std::vector<double> MetersPerUnit(const RunRecord& record);

/// Returns the landmarks of a record, in the unit of its trajectory.
std::vector<MapPoint> PointsOf(const RunRecord& record);

/// Returns CSV with a header and one row for each frame whose scale was measured: the frame, its
/// meters per unit and the standard deviation of their logarithm.
std::string MetricScaleTable(const MetricScale& scale);

}  // namespace corvo
