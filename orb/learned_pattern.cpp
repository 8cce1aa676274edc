// SPDX-License-Identifier: MIT
#include "orb/learned_pattern.h"

#include <array>
#include <cstdint>

namespace corvo::orb {
namespace {

using Coordinates = std::array<std::int8_t, 4 * kNumTests>;

constexpr Coordinates kLearned = {
#include "orb/learned_pattern.inc"
};
constexpr Coordinates kFree = {
#include "orb/free_pattern.inc"
};

Pattern PatternOf(const Coordinates& coordinates) {
  Pattern pattern;
  const std::int8_t* next = coordinates.data();
  for (auto& [p, q] : pattern) {
    p = {next[0], next[1]};
    q = {next[2], next[3]};
    next += 4;
  }
  return pattern;
}

}  // namespace

Pattern LearnedPattern() { return PatternOf(kLearned); }

Pattern FreePattern() { return PatternOf(kFree); }

}  // namespace corvo::orb
