#include "orb/kernels/resize.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

TEST(InterpolateRowTest, IsItsScalarTwin) {
  std::mt19937 random(1);
  std::vector<TapGroup> groups(40);
  for (int g = 0; g < 40; ++g) {
    TapGroup& group = groups[g];
    for (int i = 0; i < kTapReach; ++i) {
      group.first[i] = i % 2 == 0 ? random() % kTapReach : 0x80;
      group.second[i] = i % 2 == 0 ? random() % kTapReach : 0x80;
    }
    for (std::int16_t& weight : group.weight) weight = static_cast<std::int16_t>(random() % 128);
    group.base = g * 9;
    group.target = g * 7;
  }
  test::ForEveryInstructionSet([&] {
    for (unsigned seed = 0; seed < 20; ++seed) {
      auto source = test::RandomBytes(39 * 9 + kTapReach, seed);
      for (std::uint8_t& grey : source) grey = static_cast<std::uint8_t>(grey < 50 ? 0 : grey | 15);
      std::vector<std::int16_t> targets(39 * 7 + kTapsPerGroup);
      std::vector<std::int16_t> expected = targets;
      InterpolateRow(source.data(), groups.data(), 40, targets.data());
      scalar::InterpolateRow(source.data(), groups.data(), 40, expected.data());
      ASSERT_EQ(targets, expected);
    }
  });
}

TEST(BlendRowsTest, IsItsScalarTwin) {
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
