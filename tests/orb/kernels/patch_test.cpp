// SPDX-License-Identifier: MIT
#include "orb/kernels/patch.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

constexpr int kStride = 2 * kPatchRadius + 4;
constexpr int kCenter = kPatchRadius * (kStride + 1);
using Numbers = std::array<std::uint16_t, (2 * kPatchRadius + 1) * kStride>;
using Bytes = std::array<std::uint8_t, kPatchTests / 8>;

/// Returns tests between random positions of the whole patch; the first two compare its corners.
PatchTests MakeTests(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&] {
    const int x = static_cast<int>(random() % (2 * kPatchRadius + 1)) - kPatchRadius;
    const int y = static_cast<int>(random() % (2 * kPatchRadius + 1)) - kPatchRadius;
    return PatchIndex(x, y);
  };
  PatchTests tests{};
  for (std::uint16_t& index : tests.p) index = draw();
  for (std::uint16_t& index : tests.q) index = draw();
  tests.p[0] = PatchIndex(-kPatchRadius, -kPatchRadius);
  tests.q[0] = PatchIndex(kPatchRadius, kPatchRadius);
  tests.p[1] = PatchIndex(kPatchRadius, -kPatchRadius);
  tests.q[1] = PatchIndex(-kPatchRadius, kPatchRadius);
  return tests;
}

TEST(TestPatchTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (unsigned seed = 0; seed < 40; ++seed) {
      std::mt19937 random(seed);
      Numbers patch;  // In half the patches many numbers are equal.
      for (auto& n : patch) n = static_cast<std::uint16_t>(random() % (seed % 2 == 0 ? 65536 : 3));
      const PatchTests tests = MakeTests(seed);
      Bytes bytes{};
      Bytes expected{};
      TestPatch(patch.data() + kCenter, kStride, tests, bytes.data());
      scalar::TestPatch(patch.data() + kCenter, kStride, tests, expected.data());
      ASSERT_EQ(bytes, expected) << seed;
    }
  });
}

TEST(TestPatchTest, BitIsOneWhereTheNumberAtPIsLess) {
  Numbers patch{};
  patch[kCenter + 3 * kStride + 5] = 1;
  PatchTests tests{};
  tests.p.fill(PatchIndex(-10, -10));
  tests.q.fill(PatchIndex(8, 3));
  tests.q[0] = PatchIndex(5, 3);
  tests.q[9] = PatchIndex(5, 3);
  tests.p[10] = PatchIndex(5, 3);
  Bytes bytes{};
  Bytes expected{};
  expected[0] = 1;
  expected[1] = 2;
  TestPatch(patch.data() + kCenter, kStride, tests, bytes.data());
  EXPECT_EQ(bytes, expected);
}

}  // namespace
}  // namespace corvo::orb::kernels
