// SPDX-License-Identifier: MIT
#include "apps/output/camera_history.h"

#include <fmt/format.h>

#include "vo/io/decimal_time.h"

namespace corvo {

void CameraHistory::Update(const FrameOutcome& frame, const Odometry& odometry) {
  const CameraEstimate& estimate = odometry.camera_estimate();
  if (odometry.camera_prior().num_free() == 0) return;
  const bool is_same = !rows_.empty() && estimate.difference == last_.difference &&
                       estimate.covariance == last_.covariance;
  if (is_same) return;
  last_ = estimate;
  if (!rows_.empty() && rows_.back().index == frame.index) rows_.pop_back();
  rows_.push_back(
      {frame.index, frame.time_ns, ReportCalibration(odometry, std::nullopt).estimates});
}

std::string CameraHistory::Table() const {
  std::string table = "index,timestamp";
  for (const auto& estimate : rows_.front().estimates) {
    table += fmt::format(",{0},{0}_sigma", estimate.name);
  }
  table += '\n';
  for (const Row& row : rows_) {
    table += fmt::format("{},{}", row.index, FormatSeconds(row.time_ns));
    for (const auto& estimate : row.estimates) {
      table += fmt::format(",{:.9g},{:.6g}", estimate.value, estimate.sigma);
    }
    table += '\n';
  }
  return table;
}

}  // namespace corvo
