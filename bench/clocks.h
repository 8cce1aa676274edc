// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::bench {

/// Returns the processor time of the calling thread, ms. It excludes waiting and other threads.
double ThreadTimeMs();

/// Returns the processor time of all threads of the process, ms.
double ProcessTimeMs();

/// Returns the monotonic wall time since an arbitrary moment, ms.
double WallTimeMs();

}  // namespace corvo::bench
