// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

/// Bit i % 64 of word i / 64 becomes 1 iff p[i] < q[i], for `count` numbers; what remains of the
/// last word becomes 0.
void CompareRows(const std::uint16_t* p, const std::uint16_t* q, int count, std::uint64_t* words);

/// Number of bits in which two columns of `num_words` words differ.
int CountDifferences(const std::uint64_t* a, const std::uint64_t* b, int num_words);

namespace scalar {
void CompareRows(const std::uint16_t* p, const std::uint16_t* q, int count, std::uint64_t* words);
int CountDifferences(const std::uint64_t* a, const std::uint64_t* b, int num_words);
}  // namespace scalar

}  // namespace corvo::orb::kernels
