// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "orb/nearest.h"
#include "orb/types.h"

namespace corvo::orb::kernels {

/// Room for FindNearestTwo, and how much it works on at a time.
struct NearestTwoScratch {
  static constexpr int kChunk = 1024;  ///< Train descriptors.
  static constexpr int kGroup = 8;     ///< Queries.

  alignas(64) std::uint8_t train[kChunk * 64];
  alignas(64) std::uint8_t queries[kGroup / 2 * 1024];
  alignas(64) std::uint16_t rows[kChunk];
  alignas(64) std::uint16_t nearest[kGroup * 256];
};

/// Takes all train descriptors into account in nearest[i] of every query i, as Update() does with
/// one candidate.
void FindNearestTwo(std::span<const Descriptor> queries, std::span<const Descriptor> train,
                    NearestTwoScratch& scratch, Nearest* nearest);

namespace scalar {
void FindNearestTwo(std::span<const Descriptor> queries, std::span<const Descriptor> train,
                    NearestTwoScratch& scratch, Nearest* nearest);
}  // namespace scalar

}  // namespace corvo::orb::kernels
