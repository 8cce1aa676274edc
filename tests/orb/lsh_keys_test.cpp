// SPDX-License-Identifier: MIT
#include "orb/lsh_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "tests/support/random.h"

namespace corvo::orb {
namespace {

void SetBit(Descriptor& descriptor, int bit, bool value) {
  const auto mask = static_cast<std::uint8_t>(1 << (bit % 8));
  if (value) descriptor.bytes[bit / 8] |= mask;
}

/// Returns descriptors in which bits 0 to 127 are independent and bit 128 + i equals bit i.
std::vector<Descriptor> DoubledBits(int count) {
  test::Random random(1);
  std::vector<Descriptor> descriptors(count);
  for (Descriptor& descriptor : descriptors) {
    for (int bit = 0; bit < 128; ++bit) {
      const bool value = random.UniformInt(0, 1) == 1;
      SetBit(descriptor, bit, value);
      SetBit(descriptor, 128 + bit, value);
    }
  }
  return descriptors;
}

TEST(LshKeysTest, KeyConsistsOfTheChosenBits) {
  Descriptor descriptor;
  SetBit(descriptor, 3, true);
  SetBit(descriptor, 255, true);
  EXPECT_EQ(KeyOf(descriptor, {}), 0u);
  EXPECT_EQ(KeyOf(descriptor, {3}), 1u);
  EXPECT_EQ(KeyOf(descriptor, {2, 3, 4, 255}), 0b1010u);
}

TEST(LshKeysTest, KeysShareNoBit) {
  for (const auto& [tables, bits] : {std::pair(1, 8), {8, 18}, {12, 21}, {8, 32}}) {
    std::set<int> used;
    const auto keys = ChooseKeyBits(DoubledBits(500), tables, bits);
    ASSERT_EQ(keys.size(), static_cast<std::size_t>(tables));
    for (const KeyBits& key : keys) {
      EXPECT_EQ(key.size(), static_cast<std::size_t>(bits));
      used.insert(key.begin(), key.end());
    }
    EXPECT_EQ(used.size(), static_cast<std::size_t>(tables * bits));
  }
}

TEST(LshKeysTest, DependentBitsGoToDifferentKeys) {
  for (const KeyBits& key : ChooseKeyBits(DoubledBits(5000), 2, 20)) {
    std::set<int> sources;
    for (const int bit : key) sources.insert(bit % 128);
    EXPECT_EQ(sources.size(), key.size());
  }
}

TEST(LshKeysTest, ConstantBitsAreNotChosen) {
  test::Random random(2);
  std::vector<Descriptor> descriptors(1000);
  for (Descriptor& descriptor : descriptors) {
    for (int bit = 0; bit < 256; bit += 4) SetBit(descriptor, bit, random.UniformInt(0, 1) == 1);
  }
  for (const KeyBits& key : ChooseKeyBits(descriptors, 4, 16)) {
    for (const int bit : key) EXPECT_EQ(bit % 4, 0);
  }
}

TEST(LshKeysTest, BalancedBitsAreChosen) {
  test::Random random(3);
  std::vector<Descriptor> descriptors(2000);
  for (Descriptor& descriptor : descriptors) {
    for (int bit = 0; bit < 256; ++bit) {
      const double share = bit % 3 == 2 ? 0.5 : bit % 3 == 1 ? 0.95 : 0.05;
      SetBit(descriptor, bit, random.Uniform() < share);
    }
  }
  for (const KeyBits& key : ChooseKeyBits(descriptors, 4, 16)) {
    for (const int bit : key) EXPECT_EQ(bit % 3, 2);
  }
}

TEST(LshKeysTest, KeysAreChosenEvenWithoutDescriptors) {
  EXPECT_EQ(ChooseKeyBits({}, 2, 3), (std::vector<KeyBits>{{0, 2, 4}, {1, 3, 5}}));
}

TEST(ChanceOfFlipsTest, IsHypergeometric) {
  EXPECT_DOUBLE_EQ(ChanceOfFlips(1, 16, 0), 240.0 / 256);
  EXPECT_DOUBLE_EQ(ChanceOfFlips(2, 16, 0), 240.0 * 239 / (256 * 255));
  EXPECT_DOUBLE_EQ(ChanceOfFlips(2, 16, 1), 1 - 16.0 * 15 / (256 * 255));
  EXPECT_DOUBLE_EQ(ChanceOfFlips(255, 1, 0), 1.0 / 256);
}

TEST(ChanceOfFlipsTest, IsZeroOrOneWhereCertain) {
  for (int flips = 0; flips < 30; ++flips) {
    EXPECT_EQ(ChanceOfFlips(flips, 18, flips), 1);
    EXPECT_EQ(ChanceOfFlips(256, 18, flips), flips >= 18 ? 1 : 0);
  }
  EXPECT_EQ(ChanceOfFlips(0, 18, -1), 0);
}

TEST(ChanceOfFlipsTest, FallsWithDistanceAndRisesWithFlips) {
  constexpr double kRounding = 1e-12;
  for (int distance = 1; distance <= 256; ++distance) {
    for (int flips = 0; flips < 18; ++flips) {
      const double chance = ChanceOfFlips(distance, 18, flips);
      EXPECT_LE(chance, ChanceOfFlips(distance - 1, 18, flips) + kRounding);
      EXPECT_LE(chance, ChanceOfFlips(distance, 18, flips + 1) + kRounding);
    }
  }
}

TEST(ChanceOfFlipsTest, AgreesWithRandomlyDrawnKeys) {
  test::Random random(3);
  Descriptor difference;
  for (int bit = 0; bit < 40; ++bit) SetBit(difference, bit, true);
  int found = 0;
  constexpr int kRuns = 20000;
  for (int run = 0; run < kRuns; ++run) {
    std::set<std::uint8_t> bits;
    while (bits.size() < 12) bits.insert(static_cast<std::uint8_t>(random.UniformInt(0, 255)));
    found += std::popcount(KeyOf(difference, {bits.begin(), bits.end()})) <= 1;
  }
  EXPECT_NEAR(found / double{kRuns}, ChanceOfFlips(40, 12, 1), 0.015);
}

}  // namespace
}  // namespace corvo::orb
