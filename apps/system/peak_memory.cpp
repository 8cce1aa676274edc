// SPDX-License-Identifier: MIT
#include "apps/system/peak_memory.h"

#include <sys/resource.h>

namespace corvo {

double PeakMemoryMb() {
#ifdef __APPLE__
  constexpr double kUnitsPerMb = 1024 * 1024;
#else
  constexpr double kUnitsPerMb = 1024;
#endif
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kUnitsPerMb;
}

}  // namespace corvo
