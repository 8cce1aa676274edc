#include "orb/hamming.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace corvo::orb {

int HammingDistance(const Descriptor& a, const Descriptor& b) {
  std::array<std::uint64_t, 4> words_a;
  std::array<std::uint64_t, 4> words_b;
  std::memcpy(words_a.data(), a.bytes.data(), sizeof(words_a));
  std::memcpy(words_b.data(), b.bytes.data(), sizeof(words_b));
  int distance = 0;
  for (int i = 0; i < 4; ++i) distance += std::popcount(words_a[i] ^ words_b[i]);
  return distance;
}

}  // namespace corvo::orb
