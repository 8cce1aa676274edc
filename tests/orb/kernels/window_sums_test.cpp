// SPDX-License-Identifier: MIT
#include "orb/kernels/window_sums.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

TEST(SumColumnsTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int width = 1; width < 200; ++width) {
      const auto image = test::RandomBytes(5 * width, width);
      std::vector<std::uint16_t> columns(width);
      std::vector<std::uint16_t> expected(width);
      SumColumns(image.data() + 2 * width, width, width, columns.data());
      scalar::SumColumns(image.data() + 2 * width, width, width, expected.data());
      ASSERT_EQ(columns, expected) << "width " << width;
    }
  });
}

TEST(SlideColumnsTest, GivesTheSumsOfTheNextRow) {
  test::ForEveryInstructionSet([] {
    for (int width = 1; width < 200; ++width) {
      const auto image = test::RandomBytes(6 * width, width);
      std::vector<std::uint16_t> columns(width);
      std::vector<std::uint16_t> expected(width);
      scalar::SumColumns(image.data() + 2 * width, width, width, columns.data());
      std::vector<std::uint16_t> scalar_columns = columns;
      SlideColumns(image.data() + 3 * width, width, width, columns.data());
      scalar::SlideColumns(image.data() + 3 * width, width, width, scalar_columns.data());
      scalar::SumColumns(image.data() + 3 * width, width, width, expected.data());
      ASSERT_EQ(columns, expected) << "width " << width;
      ASSERT_EQ(scalar_columns, expected) << "width " << width;
    }
  });
}

TEST(SumWindowsTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int width = 5; width < 200; ++width) {
      const auto image = test::RandomBytes(5 * width, width);
      std::vector<std::uint16_t> columns(width);
      scalar::SumColumns(image.data() + 2 * width, width, width, columns.data());
      std::vector<std::uint16_t> sums(width, 7);
      std::vector<std::uint16_t> expected = sums;
      SumWindows(columns.data(), width, sums.data());
      scalar::SumWindows(columns.data(), width, expected.data());
      ASSERT_EQ(sums, expected) << "width " << width;
    }
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
