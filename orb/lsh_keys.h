// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "orb/types.h"

namespace corvo::orb {

/// The bits of a descriptor, 0 to 255, that form its key in one hash table: at most 31, all
/// different. Bit j of the key is bit bits[j] of the descriptor.
using KeyBits = std::vector<std::uint8_t>;

/// Returns the key of a descriptor, 0 to 2^bits.size() - 1.
std::uint32_t KeyOf(const Descriptor& descriptor, const KeyBits& bits);

/// Returns the number of bits in a key for tables of this many descriptors: 8 to 21, chosen to give
/// four to eight descriptors per bucket.
int BitsAKey(std::size_t num_descriptors);

/// Chooses disjoint bits for the keys of `num_tables` tables, `bits_a_key` for each; in total at
/// most 256. The bits of learned tests are correlated, and keys of correlated bits would crowd into
/// few buckets. The keys therefore take turns to add the free bit with the least
///
///     (2 m - 1)^2 + sum of r^2,
///
/// where m is its mean and r are its correlations with the bits already in the key, over up to
/// 16384 of the descriptors. Ties go to the lower bit.
std::vector<KeyBits> ChooseKeyBits(std::span<const Descriptor> descriptors, int num_tables,
                                   int bits_a_key);

/// Returns the probability that at most `max_flips` bits of a key differ between two descriptors of
/// Hamming distance `distance` (0 to 256), if all bits are equally likely to differ: the
/// hypergeometric distribution.
double ChanceOfFlips(int distance, int bits_a_key, int max_flips);

}  // namespace corvo::orb
