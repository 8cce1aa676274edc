#pragma once

#include "bench/odometry/recording.h"
#include "vo/options.h"

namespace corvo::bench {

/// Processor time of Odometry::Process, all its threads, against cv::ORB's detect-and-compute with
/// as many keypoints on the same pictures, one after the other.
struct Cost {
  int keypoints = 0;
  double odometry_ms = 0;      ///< A frame, mean of the frames' least.
  double orb_ms = 0;           ///< The same.
  double ratio = 0;            ///< Of the two.
  double p99_over_median = 0;  ///< Of Process, over frames.
};

/// Each picture's least time of `repeats` runs counts. Pictures are decoded beforehand.
Cost MeasureCost(const Recording& recording, const OdometryOptions& options, int repeats);

}  // namespace corvo::bench
