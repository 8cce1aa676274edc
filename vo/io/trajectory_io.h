// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"

namespace corvo {

// Files of poses. Every reader throws corvo::Error that starts with "<file>:<line>: " for what is
// not a pose: wrong number of fields, no number, not finite, no rotation, time not after the line
// before. Writers throw where the file cannot be written.

/// TUM: "timestamp tx ty tz qx qy qz qw" a line, seconds; `#` starts a comment. Times are read
/// exactly to the nanosecond. Quaternions within 1 ± 1e-2 of unit norm are normalized, others are
/// errors.
PoseSequence ReadTum(const std::filesystem::path& file);

/// As ReadTum, but lines that have NaN for a pose, as TUM-mono's groundtruthSync.txt has between
/// its two ends, are left out.
PoseSequence ReadTumWithGaps(const std::filesystem::path& file);

/// Seconds with 9 decimals; the other numbers in their shortest form that reads back the same.
void WriteTum(const std::filesystem::path& file, const PoseSequence& poses);

/// KITTI: the 12 numbers of [R t] a line, row by row, world_from_camera; no times.
std::vector<SE3> ReadKittiPoses(const std::filesystem::path& file);
void WriteKittiPoses(const std::filesystem::path& file, const std::vector<SE3>& poses);

/// KITTI's times.txt: seconds, one a line, ascending.
std::vector<TimeNs> ReadKittiTimes(const std::filesystem::path& file);

/// Throws corvo::Error where the counts differ.
PoseSequence WithTimes(const std::vector<SE3>& world_from_camera,
                       const std::vector<TimeNs>& times_ns);

/// EuRoC: "time_ns, px, py, pz, qw, qx, qy, qz, ..." a line; further columns are not read. In
/// EuRoC's own state_groundtruth_estimate0/data.csv the poses are world_from_body.
PoseSequence ReadEurocPoses(const std::filesystem::path& file);
void WriteEurocPoses(const std::filesystem::path& file, const PoseSequence& poses);

}  // namespace corvo
