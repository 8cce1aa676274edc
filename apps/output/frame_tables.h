// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/odometry.h"

namespace corvo {

/// The wall times of one frame, ms.
struct FrameTiming {
  double read_ms = 0;  ///< Reading and decoding the image.
  StageTimes stages;
  double total_ms = 0;  ///< The whole call of Odometry::Process().
  /// From when the image was due until its pose was known; set if images are taken in real time.
  std::optional<double> latency_ms;
};

/// Returns CSV with a header and one row per input frame. Timestamps are seconds with nine
/// decimals, `segment` is -1 before the first segment, `posed` and `keyframe` are 0 or 1,
/// `parallax` is in degrees. `images` names the image of each frame, or is empty.
std::string FrameTable(const Trajectory& trajectory, const std::vector<std::string>& images = {});

/// Returns CSV with a header and one row per frame with a relative pose: the frame, its reference
/// keyframe, reference_from_camera (tx ty tz qx qy qz qw) and the upper triangle of the covariance
/// of [υ ω], row by row. See RelativePose.
std::string RelativePoseTable(const Trajectory& trajectory);

/// Some columns of a row of frames.csv. Earlier versions did not write the last two.
struct FrameRow {
  int index = 0;
  TimeNs time_ns = 0;
  std::string state;
  int segment = kNoId;
  bool is_keyframe = false;
  std::string image;
};

/// Reads a table of FrameTable(). Throws corvo::Error with file and line if it is malformed.
std::vector<FrameRow> ReadFrameTable(const std::filesystem::path& file);

/// Returns CSV with a header and one row per input frame. A latency that is not set is empty.
std::string TimingTable(const std::vector<FrameTiming>& timings);

}  // namespace corvo
