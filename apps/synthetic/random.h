// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::synthetic {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection of 64 bits whose outputs
/// pass for random. Integer only, so that every machine agrees.
constexpr std::uint64_t Mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

/// A hash of a seed and two integers.
constexpr std::uint64_t Hash(std::uint64_t seed, std::int64_t x, std::int64_t y = 0) {
  const std::uint64_t first = Mix(seed + kGolden * (static_cast<std::uint64_t>(x) + 1));
  return Mix(first + kGolden * (static_cast<std::uint64_t>(y) + 1));
}

/// SplitMix64 as a stream of numbers: the same on every machine and standard library, so long as
/// the order of the calls is fixed: at most one among the arguments of a function.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(Mix(seed + kGolden)) {}

  std::uint64_t Next() { return Mix(state_ += kGolden); }

  /// Uniform over [low, high].
  int Between(int low, int high) {
    return low + static_cast<int>(Next() % static_cast<std::uint64_t>(high - low + 1));
  }

  /// Uniform over [low, high).
  double Uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(Next() >> 11) * 0x1p-53;
  }

  bool Chance(int percent) { return Between(0, 99) < percent; }

 private:
  std::uint64_t state_;
};

}  // namespace corvo::synthetic
