// SPDX-License-Identifier: MIT
#include "orb/learned_pattern.h"

#include <cstdint>
#include <iterator>

namespace corvo::orb {
namespace {

constexpr std::int8_t kCoordinates[] = {
#include "orb/learned_pattern.inc"
};
static_assert(std::size(kCoordinates) == 4 * kNumTests);

}  // namespace

Pattern LearnedPattern() {
  Pattern pattern;
  const std::int8_t* next = kCoordinates;
  for (auto& [p, q] : pattern) {
    p = {next[0], next[1]};
    q = {next[2], next[3]};
    next += 4;
  }
  return pattern;
}

}  // namespace corvo::orb
