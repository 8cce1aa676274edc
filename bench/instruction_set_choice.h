// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "orb/kernels/instruction_sets.h"

namespace corvo::bench {

/// Returns this machine's best instruction set and, if that is better than AVX2, AVX2 as well.
inline std::vector<std::string> BestAndAvx2() {
  std::vector<std::string> names = orb::kernels::InstructionSets();
  const auto is_other = [&](const std::string& name) { return name != "AVX2"; };
  names.erase(std::remove_if(names.begin() + 1, names.end(), is_other), names.end());
  return names;
}

}  // namespace corvo::bench
