// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// Poses as a file has them: with times, or numbered by row.
class PoseFile {
 public:
  explicit PoseFile(PoseSequence timed) : poses_(std::move(timed)), has_times_(true) {}
  explicit PoseFile(const std::vector<SE3>& numbered);

  bool has_times() const { return has_times_; }
  std::size_t size() const { return poses_.size(); }

  /// The poses with their own times, or else row i with the i-th of `times`. Throws corvo::Error
  /// naming both counts where there are not as many times as rows.
  PoseSequence WithTimes(const std::vector<TimeNs>& times) const;

  /// The poses with their own times, or else row i at i seconds.
  const PoseSequence& poses() const { return poses_; }

 private:
  PoseSequence poses_;
  bool has_times_ = false;
};

/// Recognizes the format: commas (EuRoC, time in ns), 8 columns (TUM, time in s) or 12 columns
/// (KITTI, no times). Throws corvo::Error naming file and line.
PoseFile ReadPoseFile(const std::filesystem::path& file);

/// Whether the file's first line of poses is separated by commas, as EuRoC's and TUM-VI's are.
bool IsEurocPoseFile(const std::filesystem::path& file);

}  // namespace corvo
