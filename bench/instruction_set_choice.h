// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "orb/kernels/instruction_sets.h"

namespace corvo::bench {

/// This machine's best instruction set and, where that is a better one, AVX2.
inline std::vector<std::string> BestAndAvx2() {
  std::vector<std::string> names = orb::kernels::InstructionSets();
  const auto is_other = [&](const std::string& name) { return name != "AVX2"; };
  names.erase(std::remove_if(names.begin() + 1, names.end(), is_other), names.end());
  return names;
}

}  // namespace corvo::bench
