// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/output/calibration_report.h"
#include "vo/odometry.h"

namespace corvo {

/// How the estimate of the camera changed from frame to frame.
class CameraHistory {
 public:
  /// Adds the estimate after a frame if it differs from the last one. The first one is the given
  /// camera.
  void Update(const FrameOutcome& frame, const Odometry& odometry);

  /// Returns whether no frame was added, or the camera is not estimated.
  bool empty() const { return rows_.empty(); }

  /// Returns CSV with a header and one row per estimate: the index and the timestamp of the first
  /// frame after which it held, and for each free parameter its value and its standard deviation,
  /// as in summary.json.
  std::string Table() const;

 private:
  struct Row {
    int index = 0;
    TimeNs time_ns = 0;
    std::vector<CalibrationReport::Estimate> estimates;
  };

  std::vector<Row> rows_;
  CameraEstimate last_;
};

}  // namespace corvo
