// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace corvo::orb::kernels {

// Kernels are built once for every instruction set, by Highway (https://github.com/google/highway),
// and the best one that the machine has is chosen at run time. Inflated each kernel stands its
// scalar twin in namespace `scalar`: the definition of what it computes, bit for bit.

/// The instruction sets that the kernels are built for and this machine has, best first, by their
/// names in Highway: "AVX3_DL" (AVX-512 with VNNI and VPOPCNT), "AVX3" (AVX-512), "AVX2", "SSE4",
/// "NEON", "SCALAR" or "EMU128" (the scalar twins).
std::vector<std::string> InstructionSets();

/// The one in use.
std::string ChosenInstructionSet();

/// Makes every kernel of the process use one of InstructionSets() for as long as it lives. For
/// tests and benchmarks, one at a time, and not while kernels run. Throws corvo::Error on any other
/// name.
class UseInstructionSet {
 public:
  explicit UseInstructionSet(const std::string& name);
  ~UseInstructionSet();
  UseInstructionSet(const UseInstructionSet&) = delete;
  UseInstructionSet& operator=(const UseInstructionSet&) = delete;
};

}  // namespace corvo::orb::kernels
