// SPDX-License-Identifier: MIT
#include "orb/kernels/instruction_sets.h"

#include <cstdint>

#include <hwy/highway.h>

#include "orb/error.h"

namespace corvo::orb::kernels {
namespace {

/// Choose among `targets`, a set of Highway's bits; 0: among all that the machine has.
void Allow(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::vector<std::int64_t> Targets() { return hwy::SupportedAndGeneratedTargets(); }

}  // namespace

std::vector<std::string> InstructionSets() {
  std::vector<std::string> names;
  for (const std::int64_t target : Targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

std::string ChosenInstructionSet() { return InstructionSets().front(); }

UseInstructionSet::UseInstructionSet(const std::string& name) {
  std::string allowed;
  for (const std::int64_t target : Targets()) {
    if (name == hwy::TargetName(target)) {
      Allow(target);
      return;
    }
    allowed += std::string(allowed.empty() ? "" : ", ") + hwy::TargetName(target);
  }
  throw Error("instruction set is \"" + name + "\"; this machine has " + allowed);
}

UseInstructionSet::~UseInstructionSet() { Allow(0); }

}  // namespace corvo::orb::kernels
