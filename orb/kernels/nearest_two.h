#pragma once

#include <cstdint>

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

/// Takes train descriptors 0 to num_train - 1 into account in nearest[i] of every query i, as
/// Update() does with one candidate.
void FindNearestTwo(const Descriptor* queries, int num_queries, const Descriptor* train,
                    int num_train, NearestTwoScratch& scratch, Nearest* nearest);

namespace scalar {
void FindNearestTwo(const Descriptor* queries, int num_queries, const Descriptor* train,
                    int num_train, NearestTwoScratch& scratch, Nearest* nearest);
}  // namespace scalar

}  // namespace corvo::orb::kernels
