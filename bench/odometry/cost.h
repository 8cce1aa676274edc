// SPDX-License-Identifier: MIT
#pragma once

#include "bench/odometry/recording.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// Processor time of Odometry, all its threads, against cv::ORB's detect-and-compute with as many
/// keypoints on the same images; and how long the caller of Process waits, frame after frame
/// without a pause.
struct Cost {
  int keypoints = 0;
  double odometry_ms = 0;  ///< Processor time a frame; mean over the sequence.
  double orb_ms = 0;       ///< The same.
  double ratio = 0;        ///< Of the two.
  double median_ms = 0;    ///< Time of a call of Process, over frames.
  double p99_ms = 0;       ///< The same.
};

/// Both take turns, sequence by sequence. The least of `repeats` runs counts, of each frame where
/// they are told apart. Images are decoded beforehand.
Cost MeasureCost(const Recording& recording, const OdometryOptions& options, int repeats);

}  // namespace corvo::bench
