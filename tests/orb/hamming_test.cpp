// SPDX-License-Identifier: MIT
#include "orb/hamming.h"

#include <gtest/gtest.h>

#include "tests/orb/images.h"

namespace corvo::orb {
namespace {

int CountBits(const Descriptor& a, const Descriptor& b) {
  int count = 0;
  for (int i = 0; i < 256; ++i) count += ((a.bytes[i / 8] ^ b.bytes[i / 8]) >> (i % 8)) & 1;
  return count;
}

TEST(HammingDistanceTest, CountsTheBitsThatDiffer) {
  const auto descriptors = test::RandomDescriptors(60, 1);
  for (const auto& a : descriptors) {
    for (const auto& b : descriptors) {
      EXPECT_EQ(HammingDistance(a, b), CountBits(a, b));
      EXPECT_EQ(HammingDistance(a, b), HammingDistance(b, a));
    }
    EXPECT_EQ(HammingDistance(a, a), 0);
  }
}

TEST(HammingDistanceTest, EveryBitCountsOnce) {
  for (int i = 0; i < 256; ++i) {
    Descriptor one;
    one.bytes[i / 8] = static_cast<std::uint8_t>(1 << (i % 8));
    EXPECT_EQ(HammingDistance(one, Descriptor{}), 1);
  }
}

TEST(HammingDistanceTest, ComplementsAre256Apart) {
  Descriptor ones;
  ones.bytes.fill(0xff);
  EXPECT_EQ(HammingDistance(ones, Descriptor{}), 256);
}

}  // namespace
}  // namespace corvo::orb
