// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orb/types.h"

namespace corvo::orb {

/// The bits of a descriptor that make its key in one hash table, 0 to 255: at most 31 different
/// ones. Bit j of the key is bit bits[j].
using KeyBits = std::vector<std::uint8_t>;

/// The key of a descriptor: 0 to 2^bits.size() - 1.
std::uint32_t KeyOf(const Descriptor& descriptor, const KeyBits& bits);

/// Chooses disjoint bits for the keys of `num_tables` tables, `bits_a_key` each; all of them
/// together are at most 256. Learned tests depend on one another, and keys of bits that do would
/// crowd few buckets. So the keys take turns to add, of the bits still free, the one with the least
///
///     (2 m - 1)^2 + sum of r^2,
///
/// m its mean and r its correlations with the bits that the key has, over up to 16384 of the
/// descriptors. Ties go to the lower bit.
std::vector<KeyBits> ChooseKeyBits(std::span<const Descriptor> descriptors, int num_tables,
                                   int bits_a_key);

/// The chance that, of a key's bits, at most `max_flips` are among the `distance` (0 to 256) that
/// differ between two descriptors, any as likely as any other: hypergeometric.
double ChanceOfFlips(int distance, int bits_a_key, int max_flips);

}  // namespace corvo::orb
