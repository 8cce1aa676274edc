// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <vector>

namespace corvo {

/// The wall time of the stages of one frame, ms. Never part of a result that must be reproducible.
struct StageTimes {
  double extract_ms = 0;  ///< Feature extraction.
  double locate_ms = 0;   ///< Initialization, tracking and relocalization.
  double map_ms = 0;      ///< Creation, fusion and culling of landmarks and keyframes.
  double adjust_ms = 0;   ///< Starting bundle adjustments and waiting for their results.
};

/// A clock for the stages of a frame. A nested stage stops the clock of the enclosing one, so that
/// no time is counted twice.
class StageClock {
 public:
  /// A stage, which lasts as long as this object.
  class Scope {
   public:
    Scope(StageClock& clock, double StageTimes::*stage) : clock_(clock) { clock_.Enter(stage); }
    ~Scope() { clock_.Leave(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageClock& clock_;
  };

  /// Resets all times to 0. Must be called outside all stages.
  void Reset() { times_ = StageTimes(); }
  const StageTimes& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;

  void Enter(double StageTimes::*stage) {
    AddLap();
    stages_.push_back(stage);
  }
  void Leave() {
    AddLap();
    stages_.pop_back();
  }
  /// Adds the time since the last change to the innermost stage.
  void AddLap() {
    const Clock::time_point now = Clock::now();
    if (!stages_.empty()) {
      times_.*stages_.back() += std::chrono::duration<double, std::milli>(now - lap_start_).count();
    }
    lap_start_ = now;
  }

  StageTimes times_;
  std::vector<double StageTimes::*> stages_;  // The innermost is the last.
  Clock::time_point lap_start_;
};

}  // namespace corvo
