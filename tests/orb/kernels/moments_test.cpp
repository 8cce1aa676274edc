// SPDX-License-Identifier: MIT
#include "orb/kernels/moments.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

constexpr int kSide = 2 * kMomentRadius + 3;  // with a margin of one pixel
constexpr int kMomentCenter = (kMomentRadius + 1) * (kSide + 1);

TEST(SumDiscMomentsTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (unsigned seed = 0; seed < 50; ++seed) {
      const auto image = test::RandomBytes(kSide * kSide, seed);
      EXPECT_EQ(SumDiscMoments(image.data() + kMomentCenter, kSide),
                scalar::SumDiscMoments(image.data() + kMomentCenter, kSide));
    }
  });
}

TEST(SumDiscMomentsTest, StrongestContrastDoesNotOverflow) {
  std::vector<std::uint8_t> image(kSide * kSide, 0);
  for (int i = kMomentCenter; i < kSide * kSide; ++i) image[i] = 255;
  test::ForEveryInstructionSet([&] {
    EXPECT_EQ(SumDiscMoments(image.data() + kMomentCenter, kSide),
              scalar::SumDiscMoments(image.data() + kMomentCenter, kSide));
  });
}

TEST(SumDiscMomentsTest, EqualsTheSumOverTheDisc) {
  const auto image = test::RandomBytes(kSide * kSide, 1);
  DiscMoments expected;
  for (int dy = -15; dy <= 15; ++dy) {
    for (int dx = -15; dx <= 15; ++dx) {
      if (dx * dx + dy * dy > 225) continue;
      expected.x += dx * image[kMomentCenter + dy * kSide + dx];
      expected.y += dy * image[kMomentCenter + dy * kSide + dx];
    }
  }
  EXPECT_EQ(scalar::SumDiscMoments(image.data() + kMomentCenter, kSide), expected);
}

}  // namespace
}  // namespace corvo::orb::kernels
