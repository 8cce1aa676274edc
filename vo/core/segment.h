// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "vo/core/conventions.h"

namespace corvo {

/// The origin of the scale of a segment.
enum class ScaleSource : std::uint8_t {
  kArbitrary,      ///< Unrelated to the scale of any other segment.
  kMedianSpeed,    ///< The camera was assumed to move on at its median speed before the loss.
  kCameraHeight,   ///< In meters: the height of the camera above the ground is known.
  kKnownDistance,  ///< In meters: the distance between two positions of the camera is known.
  kKnownSize,      ///< In meters: the size of an object is known.
};

/// Returns "arbitrary", "median_speed", "camera_height", "known_distance" or "known_size".
std::string_view ToString(ScaleSource source);

/// Returns whether lengths are in meters.
bool IsMetric(ScaleSource source);

/// The scale of a segment relative to that of the segment before or, if it is known, to the meter.
struct SegmentScale {
  ScaleSource source = ScaleSource::kArbitrary;
  /// The standard deviation of the scale as a factor, at least 1: the true ratio of the two scales
  /// is within this factor of the guess with a probability of about 68%. Unset if the scale is
  /// arbitrary or its error is not known. For segments further apart, the logarithms of the factors
  /// add up in squares.
  std::optional<double> factor = std::nullopt;

  bool operator==(const SegmentScale&) const = default;
};

/// A segment of a trajectory: frames whose poses have one scale.
struct Segment {
  int index = kNoId;        ///< FrameOutcome::segment of its frames.
  int first_frame = kNoId;  ///< Index of its first posed frame.
  int last_frame = kNoId;   ///< Index of its last posed frame.
  int num_poses = 0;
  SegmentScale scale;

  bool operator==(const Segment&) const = default;
};

}  // namespace corvo
