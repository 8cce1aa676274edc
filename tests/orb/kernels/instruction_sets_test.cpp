// SPDX-License-Identifier: MIT
#include "orb/kernels/instruction_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "orb/error.h"

namespace corvo::orb::kernels {
namespace {

using testing::HasSubstr;

#if defined(__x86_64__)
/// Returns the best instruction set according to the compiler's processor detection.
std::string BestByCpuid() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    const bool vpopcnt = __builtin_cpu_supports("avx512vpopcntdq");
    const bool vnni = __builtin_cpu_supports("avx512vnni");
    return vpopcnt && vnni && __builtin_cpu_supports("avx512vbmi2") ? "AVX3_DL" : "AVX3";
  }
  if (__builtin_cpu_supports("avx2")) return "AVX2";
  if (__builtin_cpu_supports("sse4.2")) return "SSE4";
  return "SCALAR";
}

TEST(InstructionSetsTest, TheBestSupportedSetIsChosen) {
  std::cout << "chosen: " << ChosenInstructionSet() << "\n";
  EXPECT_EQ(ChosenInstructionSet(), BestByCpuid());
}
#endif

TEST(InstructionSetsTest, EverySupportedSetCanBeForced) {
  const std::string best = ChosenInstructionSet();
  for (const std::string& name : InstructionSets()) {
    const UseInstructionSet use(name);
    EXPECT_EQ(ChosenInstructionSet(), name);
  }
  EXPECT_EQ(ChosenInstructionSet(), best);
}

TEST(InstructionSetsTest, UnknownSetThrowsAndListsTheSupportedSets) {
  try {
    const UseInstructionSet use("MMX");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"MMX\""));
    EXPECT_THAT(error.what(), HasSubstr(ChosenInstructionSet()));
  }
}

}  // namespace
}  // namespace corvo::orb::kernels
