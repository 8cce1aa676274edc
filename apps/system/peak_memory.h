// SPDX-License-Identifier: MIT
#pragma once

namespace corvo {

/// Returns the most memory that this process has had resident, in MiB.
double PeakMemoryMb();

}  // namespace corvo
