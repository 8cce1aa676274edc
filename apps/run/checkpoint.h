// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/output/output_folder.h"
#include "apps/run/run_inputs.h"
#include "apps/run/stopwatch.h"
#include "vo/odometry.h"

namespace corvo {

/// Saves what a run has found so far every few seconds, so that it survives however the run ends:
/// trajectory.tum, frames.csv and a short summary.json. It does not affect the results.
class Checkpoint {
 public:
  /// The objects must outlive this one.
  Checkpoint(const RunArguments& arguments, const RunInputs& inputs, const OutputFolder& output,
             double min_interval_ms = 5000);

  /// Saves a checkpoint if the last one is long enough ago: the least interval and 20 times its
  /// duration, so that they take less than 5% of the time. Logs a warning once if it cannot be
  /// written.
  void Update(const Odometry& odometry);
  /// Saves a checkpoint at once; `why` says how the run ended. Throws corvo::Error if it cannot be
  /// written.
  void Save(const Odometry& odometry, const std::string& why) const;

 private:
  const RunArguments& arguments_;
  const RunInputs& inputs_;
  const OutputFolder& output_;
  Stopwatch watch_;
  double min_interval_ms_;
  double due_ms_;
  bool has_warned_ = false;
};

}  // namespace corvo
