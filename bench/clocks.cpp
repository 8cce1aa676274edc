// SPDX-License-Identifier: MIT
#include "bench/clocks.h"

#include <time.h>

namespace corvo::bench {
namespace {

double ReadMs(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double ThreadTimeMs() { return ReadMs(CLOCK_THREAD_CPUTIME_ID); }

double ProcessTimeMs() { return ReadMs(CLOCK_PROCESS_CPUTIME_ID); }

double WallTimeMs() { return ReadMs(CLOCK_MONOTONIC); }

}  // namespace corvo::bench
