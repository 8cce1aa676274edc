#include "orb/kernels/patch.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

constexpr int kSide = 2 * (kPatchRadius + 2) + 1;
constexpr int kCentre = (kPatchRadius + 2) * (kSide + 1);
using Bytes = std::array<std::uint8_t, kPatchTests / 8>;

/// Tests between windows drawn at random from the whole patch; the first ones from its corners.
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

TEST(TestPatchTest, IsItsScalarTwin) {
  test::ForEveryInstructionSet([] {
    for (unsigned seed = 0; seed < 40; ++seed) {
      auto image = test::RandomBytes(kSide * kSide, seed);
      if (seed % 2 == 0) {  // Equal sums are frequent.
        for (std::uint8_t& grey : image) grey = static_cast<std::uint8_t>(grey < 10 ? 255 : 254);
      }
      const PatchTests tests = MakeTests(seed);
      Bytes bytes{};
      Bytes expected{};
      TestPatch(image.data() + kCentre, kSide, tests, bytes.data());
      scalar::TestPatch(image.data() + kCentre, kSide, tests, expected.data());
      ASSERT_EQ(bytes, expected) << seed;
    }
  });
}

TEST(TestPatchTest, OnePixelBrightensTheWindowsThatHoldIt) {
  std::vector<std::uint8_t> image(kSide * kSide, 7);
  image[kCentre + 3 * kSide + 5] = 8;
  PatchTests tests{};
  tests.p.fill(PatchIndex(-10, -10));
  tests.q.fill(PatchIndex(8, 3));
  tests.q[0] = PatchIndex(5, 3);
  tests.q[9] = PatchIndex(7, 5);
  Bytes bytes{};
  Bytes expected{};
  expected[0] = 1;
  expected[1] = 2;
  TestPatch(image.data() + kCentre, kSide, tests, bytes.data());
  EXPECT_EQ(bytes, expected);
}

}  // namespace
}  // namespace corvo::orb::kernels
