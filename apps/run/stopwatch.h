// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace corvo {

/// Measures the wall time since construction and since the last lap.
class Stopwatch {
 public:
  double ElapsedMs() const { return Ms(Clock::now() - start_); }

  /// Returns the time since the previous call, or since construction, and starts a new lap.
  double LapMs() {
    const Clock::time_point now = Clock::now();
    const double lap_ms = Ms(now - lap_);
    lap_ = now;
    return lap_ms;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double Ms(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  }

  Clock::time_point start_ = Clock::now();
  Clock::time_point lap_ = start_;
};

}  // namespace corvo
