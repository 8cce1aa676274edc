// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "orb/kernels/instruction_sets.h"

namespace corvo::test {

/// Runs `body` once with each instruction set of this machine in use.
template <typename Body>
void ForEveryInstructionSet(const Body& body) {
  for (const std::string& name : orb::kernels::InstructionSets()) {
    SCOPED_TRACE(name);
    const orb::kernels::UseInstructionSet use(name);
    body();
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Returns independent bytes, which are the same with every standard library.
inline std::vector<std::uint8_t> RandomBytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

}  // namespace corvo::test
