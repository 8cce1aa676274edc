// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/lie/sim3.h"
#include "vo/map/frame.h"

namespace corvo {

/// A prediction of the camera's speed.
struct SpeedGuess {
  double speed = 0;      ///< In units of the map per second.
  double log_sigma = 0;  ///< Standard deviation of the logarithm of the speed.
};

/// The speeds of the camera between consecutive tracked frames during the last second of tracking
/// (`speed_window_s`).
class SpeedHistory {
 public:
  explicit SpeedHistory(const SegmentStartOptions& options = {}) : options_(options) {}

  /// Adds the motion between two posed frames. A motion without translation is left out.
  void Add(const Frame& earlier, const Frame& later);

  /// Removes all motions: those of another segment have another unit.
  void Clear() { motions_.clear(); }

  /// Expresses all motions in another segment.
  void Transform(const Sim3& to_from_from);

  /// Returns the median speed as a guess of the speed up to `time_ns`, or std::nullopt if there is
  /// no motion, or if there are `min_speeds` of them and consecutive ones point in opposite
  /// directions on average: that is the noise of the poses of a camera that stands still. With the
  /// gap T in seconds between the newest motion and `time_ns`, the number n of speeds and their
  /// spread s = 1.4826 median |log(speed / median speed)|, but at least `unknown_speed_spread` if n
  /// < `min_speeds`,
  ///
  ///     log_sigma² = s² (1 + T) + speed_growth² T
  ///
  /// which is a random walk of the logarithm of the speed: it spreads by s within a second, or by
  /// `speed_growth` if the speed has been constant.
  std::optional<SpeedGuess> Predict(TimeNs time_ns) const;

 private:
  struct Motion {
    TimeNs time_ns;          // Its end.
    Eigen::Vector3d vector;  // From the earlier to the later position, in the world.
    double speed;
  };

  bool IsNoise() const;

  SegmentStartOptions options_;
  std::deque<Motion> motions_;
};

}  // namespace corvo
