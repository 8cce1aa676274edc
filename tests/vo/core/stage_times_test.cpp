// SPDX-License-Identifier: MIT
#include "vo/core/stage_times.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace corvo {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

void Sleep() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

TEST(StageClockTest, NestedStagePausesTheOuterOne) {
  StageClock clock;
  const auto start = std::chrono::steady_clock::now();
  {
    const StageClock::Scope outer(clock, &StageTimes::locate_ms);
    Sleep();
    {
      const StageClock::Scope inner(clock, &StageTimes::map_ms);
      Sleep();
    }
    Sleep();
  }
  const Milliseconds elapsed = std::chrono::steady_clock::now() - start;
  const StageTimes& times = clock.times();
  EXPECT_GE(times.locate_ms, 10);
  EXPECT_GE(times.map_ms, 5);
  EXPECT_EQ(times.extract_ms, 0);
  EXPECT_LE(times.locate_ms + times.map_ms, elapsed.count());
}

TEST(StageClockTest, TimesAccumulateUntilReset) {
  StageClock clock;
  for (int i = 0; i < 2; ++i) {
    const StageClock::Scope scope(clock, &StageTimes::adjust_ms);
    Sleep();
  }
  EXPECT_GE(clock.times().adjust_ms, 10);
  clock.Reset();
  EXPECT_EQ(clock.times().adjust_ms, 0);
}

}  // namespace
}  // namespace corvo
