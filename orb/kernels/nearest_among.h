// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "orb/nearest.h"
#include "orb/types.h"

namespace corvo::orb::kernels {

/// The two of train[candidates[i]], i < count, that are nearest to `query`. Candidates differ and
/// come in any order; between equal distances the lower one is nearer.
Nearest FindNearestAmong(const Descriptor& query, const Descriptor* train,
                         const std::int32_t* candidates, int count);

namespace scalar {
Nearest FindNearestAmong(const Descriptor& query, const Descriptor* train,
                         const std::int32_t* candidates, int count);
}  // namespace scalar

}  // namespace corvo::orb::kernels
