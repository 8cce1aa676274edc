// SPDX-License-Identifier: MIT
#pragma once

#include "bench/odometry/recording.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// The processor time of Odometry with all its threads, that of cv::ORB's detectAndCompute() with
/// the same number of keypoints on the same images, and the duration of Odometry::Process() if
/// frames follow each other without a pause.
struct Cost {
  int keypoints = 0;
  double odometry_ms = 0;  ///< Processor time per frame, mean over the sequence.
  double orb_ms = 0;       ///< Processor time of cv::ORB per frame, mean.
  double ratio = 0;        ///< odometry_ms / orb_ms.
  double median_ms = 0;    ///< Wall time of Process(), median over frames.
  double p99_ms = 0;       ///< Wall time of Process(), 99th percentile over frames.
};

/// Measures the cost on a recording. Odometry and cv::ORB alternate on the whole recording,
/// `repeats` times; the least total and the least time of each frame count. Images are decoded
/// beforehand.
Cost MeasureCost(const Recording& recording, const OdometryOptions& options, int repeats);

}  // namespace corvo::bench
