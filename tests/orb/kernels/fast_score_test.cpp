// SPDX-License-Identifier: MIT
#include "orb/kernels/fast_score.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

constexpr int kRows = 2 * kCircleRadius + 1;

/// Returns rows of noise. Two of three seeds have only three gray levels, so that corners, ties and
/// extremes are frequent.
std::vector<std::uint8_t> MakeRows(int stride, unsigned seed) {
  std::vector<std::uint8_t> rows = test::RandomBytes(kRows * stride, seed);
  for (std::uint8_t& byte : rows) {
    byte = static_cast<std::uint8_t>(seed % 3 == 0 ? byte : byte < 60 ? 0 : byte < 90 ? 100 : 255);
  }
  return rows;
}

TEST(ScoreFastRowTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int width = 1; width < 260; ++width) {
      const int stride = width + 2 * kCircleRadius;
      const auto rows = MakeRows(stride, width);
      const std::uint8_t* row = rows.data() + kCircleRadius * (stride + 1);
      for (const int threshold : {1, 7, 60, 254}) {
        std::vector<std::uint8_t> scores(width, 9);
        std::vector<std::uint8_t> expected = scores;
        ScoreFastRow(row, stride, width, threshold, scores.data());
        scalar::ScoreFastRow(row, stride, width, threshold, expected.data());
        ASSERT_EQ(scores, expected) << "width " << width << ", threshold " << threshold;
      }
    }
  });
}

TEST(ScoreFastRowTest, NoiseHasCorners) {
  const auto rows = MakeRows(1000, 1);
  std::vector<std::uint8_t> scores(990);
  ScoreFastRow(rows.data() + 3 * 1000 + 3, 1000, 990, 20, scores.data());
  EXPECT_GT(std::count_if(scores.begin(), scores.end(), [](int score) { return score > 0; }), 5);
}

TEST(FindRowMaximaTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int width = 1; width < 260; ++width) {
      auto rows = test::RandomBytes(3 * (width + 2), width);
      for (std::uint8_t& byte : rows) byte = static_cast<std::uint8_t>(byte < 128 ? 0 : byte % 20);
      const std::uint8_t* above = rows.data() + 1;
      const std::uint8_t* here = above + width + 2;
      const std::uint8_t* below = here + width + 2;
      std::vector<std::uint16_t> columns(width + kMaximaRoom);
      std::vector<std::uint16_t> expected(width);
      columns.resize(FindRowMaxima(above, here, below, width, columns.data()));
      expected.resize(scalar::FindRowMaxima(above, here, below, width, expected.data()));
      ASSERT_EQ(columns, expected) << "width " << width;
    }
  });
}

TEST(FindRowMaximaTest, EqualNeighborsSuppressOneAnother) {
  const std::vector<std::uint8_t> none(10, 0);
  const std::vector<std::uint8_t> scores = {0, 0, 5, 5, 0, 7, 0, 3, 4, 0};
  std::vector<std::uint16_t> columns(8 + kMaximaRoom);
  const int count =
      FindRowMaxima(none.data() + 1, scores.data() + 1, none.data() + 1, 8, columns.data());
  columns.resize(count);
  EXPECT_EQ(columns, (std::vector<std::uint16_t>{4, 7}));
}

}  // namespace
}  // namespace corvo::orb::kernels
