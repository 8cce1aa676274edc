// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::bench {

/// Processor time of the calling thread, ms. What else the machine does while it waits is not in
/// it.
double ThreadTimeMs();

/// Processor time of all threads of the process, ms.
double ProcessTimeMs();

/// Time since some moment, ms.
double WallTimeMs();

}  // namespace corvo::bench
