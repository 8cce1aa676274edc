// SPDX-License-Identifier: MIT
#include "orb/kernels/resize.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

TEST(InterpolateRowTest, MatchesTheScalarVersion) {
  constexpr int kCount = 43;
  std::mt19937 random(1);
  std::vector<std::uint8_t> taps(kCount * kTapReach);
  std::vector<std::uint8_t> weights(kCount * kTapReach);
  std::vector<std::int32_t> bases(kCount);
  for (std::uint8_t& tap : taps) tap = static_cast<std::uint8_t>(random() % kTapReach);
  for (int i = 0; i < kCount * kTapReach; i += 2) {
    weights[i + 1] = static_cast<std::uint8_t>(random() % 128);
    weights[i] = static_cast<std::uint8_t>(128 - weights[i + 1]);
  }
  for (int g = 0; g < kCount; ++g) bases[g] = 9 * g;
  const TapGroups groups{kCount, taps.data(), weights.data(), bases.data()};
  test::ForEveryInstructionSet([&] {
    for (unsigned seed = 0; seed < 20; ++seed) {
      auto source = test::RandomBytes((kCount - 1) * 9 + kTapReach, seed);
      for (std::uint8_t& gray : source)
        gray = static_cast<std::uint8_t>(gray < 50 ? 0 : gray > 200 ? 255 : gray);
      std::vector<std::int16_t> row(kCount * kTapsPerGroup);
      std::vector<std::int16_t> expected = row;
      InterpolateRow(source.data(), groups, row.data());
      scalar::InterpolateRow(source.data(), groups, expected.data());
      ASSERT_EQ(row, expected);
    }
  });
}

TEST(BlendRowsTest, MatchesTheScalarVersion) {
  std::mt19937 random(2);
  constexpr int kMost = 255 << kWeightBits;
  test::ForEveryInstructionSet([&] {
    for (int weight = 0; weight < 1 << kWeightBits; ++weight) {
      const int width = 1 + weight * 3;
      std::vector<std::int16_t> a(width);
      std::vector<std::int16_t> b(width);
      for (std::int16_t& value : a) value = static_cast<std::int16_t>(random() % (kMost + 1));
      for (std::int16_t& value : b) value = static_cast<std::int16_t>(random() % (kMost + 1));
      a.front() = kMost;
      b.front() = 0;
      b.back() = kMost;
      std::vector<std::uint8_t> blended(width);
      std::vector<std::uint8_t> expected(width);
      BlendRows(a.data(), b.data(), weight, width, blended.data());
      scalar::BlendRows(a.data(), b.data(), weight, width, expected.data());
      ASSERT_EQ(blended, expected) << "weight " << weight;
    }
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
