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
  explicit PoseFile(PoseSequence timed, bool is_euroc = false)
      : poses_(std::move(timed)), has_times_(true), is_euroc_(is_euroc) {}
  explicit PoseFile(const std::vector<SE3>& numbered);

  bool has_times() const { return has_times_; }
  /// Returns whether the file is in EuRoC format, in which ground truth has the poses of the body.
  bool is_euroc() const { return is_euroc_; }
  std::size_t size() const { return poses_.size(); }

  /// Returns the poses with their own timestamps, or else with the i-th of `times` for row i.
  /// Throws corvo::Error with both counts if the number of times differs from the number of rows.
  PoseSequence WithTimes(const std::vector<TimeNs>& times) const;

  /// Returns the poses with their own timestamps, or else with i seconds for row i.
  const PoseSequence& poses() const { return poses_; }

 private:
  PoseSequence poses_;
  bool has_times_ = false;
  bool is_euroc_ = false;
};

/// Reads a file, which may be a pipe, whose format is recognized by its first pose: separated by
/// commas and with a timestamp in ns (EuRoC), 8 columns (TUM), or 12 or 16 columns (KITTI, no
/// timestamps). Throws corvo::Error with file and line if it is malformed.
PoseFile ReadPoseFile(const std::filesystem::path& file);

}  // namespace corvo
