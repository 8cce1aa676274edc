// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "orb/types.h"

namespace corvo::orb::kernels {

/// Sets distances[i] to the bits in which `query` and train[candidates[i]] differ, i < count.
/// Candidates come in any order, and more than once if need be. Made for sets that are far larger
/// than the caches.
void FindDistancesAmong(const Descriptor& query, const Descriptor* train,
                        const std::uint32_t* candidates, int count, std::uint16_t* distances);

namespace scalar {
void FindDistancesAmong(const Descriptor& query, const Descriptor* train,
                        const std::uint32_t* candidates, int count, std::uint16_t* distances);
}  // namespace scalar

}  // namespace corvo::orb::kernels
