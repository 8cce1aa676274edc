// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// The poses of a file, with timestamps or numbered by row.
class PoseFile {
 public:
  explicit PoseFile(PoseSequence timed) : poses_(std::move(timed)), has_times_(true) {}
  explicit PoseFile(const std::vector<SE3>& numbered);

  bool has_times() const { return has_times_; }
  std::size_t size() const { return poses_.size(); }

  /// Returns the poses with their own timestamps, or else with the i-th of `times` for row i.
  /// Throws corvo::Error with both counts if the number of times differs from the number of rows.
  PoseSequence WithTimes(const std::vector<TimeNs>& times) const;

  /// Returns the poses with their own timestamps, or else with i seconds for row i.
  const PoseSequence& poses() const { return poses_; }

 private:
  PoseSequence poses_;
  bool has_times_ = false;
};

/// Reads a file whose format is recognized by commas (EuRoC, timestamps in ns), 8 columns (TUM,
/// timestamps in s) or 12 columns (KITTI, no timestamps). Throws corvo::Error with file and line if
/// it is malformed.
PoseFile ReadPoseFile(const std::filesystem::path& file);

/// Returns whether the first pose in the file is separated by commas, as in EuRoC and TUM-VI.
bool IsEurocPoseFile(const std::filesystem::path& file);

}  // namespace corvo
