// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"

namespace corvo {

// Every reader throws a corvo::Error that starts with "<file>:<line>: " if a line is not a pose:
// wrong number of fields, not a number, not finite, not a rotation, or a time not after that of the
// previous line. Writers throw corvo::Error if the file cannot be written.

/// Reads TUM's format: "timestamp tx ty tz qx qy qz qw" on each line, in seconds; `#` starts a
/// comment. Times are read exactly to the nanosecond. Quaternions within 1 ± 1e-2 of unit norm are
/// normalized, others are errors.
PoseSequence ReadTum(const std::filesystem::path& file);

/// Like ReadTum(), but leaves out lines with NaN for a pose, which TUM-mono's groundtruthSync.txt
/// has between its two ends.
PoseSequence ReadTumWithGaps(const std::filesystem::path& file);

/// Writes TUM's format: seconds with 9 decimals, and the other numbers in their shortest form that
/// reads back unchanged.
void WriteTum(const std::filesystem::path& file, const PoseSequence& poses);

/// Poses under a comment.
struct CommentedPoses {
  std::string comment;  ///< One line, without `#`.
  PoseSequence poses;
};

/// Writes parts of one trajectory like WriteTum(), one after the other, each after its comment.
void WriteTumParts(const std::filesystem::path& file, const std::vector<CommentedPoses>& parts);

/// Reads KITTI's format: the 12 numbers of [R t] on each line, row by row, world_from_camera; no
/// times.
std::vector<SE3> ReadKittiPoses(const std::filesystem::path& file);
void WriteKittiPoses(const std::filesystem::path& file, const std::vector<SE3>& poses);

/// Reads KITTI's times.txt: seconds, one time on each line, ascending.
std::vector<TimeNs> ReadKittiTimes(const std::filesystem::path& file);

/// Combines poses with their times. Throws corvo::Error if the counts differ.
PoseSequence WithTimes(const std::vector<SE3>& world_from_camera,
                       const std::vector<TimeNs>& times_ns);

/// Reads EuRoC's format: "time_ns, px, py, pz, qw, qx, qy, qz, ..." on each line; further columns
/// are ignored. In EuRoC's own state_groundtruth_estimate0/data.csv the poses are world_from_body.
PoseSequence ReadEurocPoses(const std::filesystem::path& file);
void WriteEurocPoses(const std::filesystem::path& file, const PoseSequence& poses);

}  // namespace corvo
