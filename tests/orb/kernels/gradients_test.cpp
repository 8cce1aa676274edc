// SPDX-License-Identifier: MIT
#include "orb/kernels/gradients.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

TEST(SumSquaredGradientsTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int count = 0; count < 300; ++count) {
      const auto row = test::RandomBytes(count + 1, count);
      const auto below = test::RandomBytes(count + 1, count + 1000);
      ASSERT_EQ(SumSquaredGradients(row.data(), below.data(), count),
                scalar::SumSquaredGradients(row.data(), below.data(), count))
          << "count " << count;
    }
  });
}

TEST(SumSquaredGradientsTest, StrongestContrastDoesNotOverflow) {
  constexpr std::int64_t kCount = 65535;
  std::vector<std::uint8_t> row(kCount + 1);
  std::vector<std::uint8_t> below(kCount);
  for (int x = 0; x < kCount; ++x) (x % 2 == 0 ? row : below)[x] = 255;
  test::ForEveryInstructionSet([&] {
    EXPECT_EQ(SumSquaredGradients(row.data(), below.data(), kCount), 2 * kCount * 255 * 255);
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
