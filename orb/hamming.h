// SPDX-License-Identifier: MIT
#pragma once

#include "orb/types.h"

namespace corvo::orb {

/// Returns the number of bits that differ, 0 to 256.
int HammingDistance(const Descriptor& a, const Descriptor& b);

}  // namespace corvo::orb
