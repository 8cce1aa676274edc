// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::synthetic {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): a bijection of 64 bits whose outputs
/// are pseudorandom. It uses integers only, so that results are the same on every machine.
constexpr std::uint64_t Mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

/// Returns a hash of a seed and two integers.
constexpr std::uint64_t Hash(std::uint64_t seed, std::int64_t x, std::int64_t y = 0) {
  const std::uint64_t first = Mix(seed + kGolden * (static_cast<std::uint64_t>(x) + 1));
  return Mix(first + kGolden * (static_cast<std::uint64_t>(y) + 1));
}

/// The SplitMix64 generator. Its numbers are the same for every machine and standard library if the
/// order of the calls is fixed, so the arguments of a function must contain at most one call.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(Mix(seed + kGolden)) {}

  std::uint64_t Next() { return Mix(state_ += kGolden); }

  /// Returns a uniform sample from [low, high].
  int Between(int low, int high) {
    return low + static_cast<int>(Next() % static_cast<std::uint64_t>(high - low + 1));
  }

  /// Returns a uniform sample from [low, high).
  double Uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(Next() >> 11) * 0x1p-53;
  }

  bool Chance(int percent) { return Between(0, 99) < percent; }

 private:
  std::uint64_t state_;
};

}  // namespace corvo::synthetic
