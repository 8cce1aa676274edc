#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vo/trajectory.h"

namespace corvo {

/// Poses as a file has them: with times (TUM format, 8 columns) or numbered by row (KITTI format,
/// 12 columns).
class PoseFile {
 public:
  explicit PoseFile(PoseSequence timed) : poses_(std::move(timed)), has_times_(true) {}
  explicit PoseFile(const std::vector<SE3>& numbered);

  bool has_times() const { return has_times_; }
  std::size_t size() const { return poses_.size(); }

  /// The poses with their own times, or else row i with the i-th of `times`. Rows and times beyond
  /// the shorter of the two are left out.
  PoseSequence WithTimes(const std::vector<TimeNs>& times) const;

  /// The poses with their own times, or else row i at i seconds.
  const PoseSequence& poses() const { return poses_; }

 private:
  PoseSequence poses_;
  bool has_times_ = false;
};

/// Recognises the format by the number of columns. Throws corvo::Error naming file and line.
PoseFile ReadPoseFile(const std::filesystem::path& file);

}  // namespace corvo
