// SPDX-License-Identifier: MIT
#include "orb/learned_pattern.h"

#include <cstdint>

namespace corvo::orb {
namespace {

constexpr std::int8_t kLearned[] = {
#include "orb/learned_pattern.inc"
};
constexpr std::int8_t kFree[] = {
#include "orb/free_pattern.inc"
};

Pattern PatternOf(const std::int8_t (&coordinates)[4 * kNumTests]) {
  Pattern pattern;
  const std::int8_t* next = coordinates;
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
