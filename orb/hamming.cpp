// SPDX-License-Identifier: MIT
#include "orb/hamming.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace corvo::orb {
namespace {

/// Returns a word whose bytes are the numbers of set bits in the bytes of `word`.
std::uint64_t CountBitsOfBytes(std::uint64_t word) {
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  return (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
}

/// Returns the sum of the bytes, which are at most 127.
int SumBytes(std::uint64_t bytes) {
  const std::uint64_t pairs = (bytes & 0x00ff00ff00ff00ff) + (bytes >> 8 & 0x00ff00ff00ff00ff);
  return static_cast<int>(pairs * 0x0001000100010001 >> 48);
}

}  // namespace

// The population count instruction is not used, since not every processor has it. The kernels use
// it.
int HammingDistance(const Descriptor& a, const Descriptor& b) {
  std::array<std::uint64_t, 4> words_a;
  std::array<std::uint64_t, 4> words_b;
  std::memcpy(words_a.data(), a.bytes.data(), sizeof(words_a));
  std::memcpy(words_b.data(), b.bytes.data(), sizeof(words_b));
  std::uint64_t counts = 0;
  for (int i = 0; i < 4; ++i) counts += CountBitsOfBytes(words_a[i] ^ words_b[i]);
  return SumBytes(counts);
}

}  // namespace corvo::orb
