// SPDX-License-Identifier: MIT
#include "orb/kernels/window_sums.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

TEST(SumWindowRowTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int width = 5; width < 200; ++width) {
      const auto image = test::RandomBytes(5 * width, width);
      std::vector<std::uint16_t> columns(width);
      std::vector<std::uint16_t> sums(width, 7);
      std::vector<std::uint16_t> expected = sums;
      SumWindowRow(image.data() + 2 * width, width, width, columns.data(), sums.data());
      scalar::SumWindowRow(image.data() + 2 * width, width, width, columns.data(), expected.data());
      ASSERT_EQ(sums, expected) << "width " << width;
    }
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
