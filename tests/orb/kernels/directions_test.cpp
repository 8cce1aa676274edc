// SPDX-License-Identifier: MIT
#include "orb/kernels/directions.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

/// Returns all vectors of small integers, including the axes, the diagonals and zero, and random
/// large ones.
std::vector<DiscMoments> MakeMoments() {
  std::vector<DiscMoments> moments;
  for (int y = -40; y <= 40; ++y) {
    for (int x = -40; x <= 40; ++x) moments.push_back({x, y});
  }
  std::mt19937 random(1);
  const auto draw = [&] { return static_cast<int>(random() % 3000001) - 1500000; };
  for (int i = 0; i < 20000; ++i) moments.push_back({draw(), draw()});
  moments.push_back({1500000, -1});
  return moments;
}

TEST(FindDirectionsDegTest, MatchesTheScalarVersion) {
  const std::vector<DiscMoments> moments = MakeMoments();
  std::vector<float> expected(moments.size());
  scalar::FindDirectionsDeg(moments, expected);
  test::ForEveryInstructionSet([&] {
    std::vector<float> directions(moments.size());
    FindDirectionsDeg(moments, directions);
    EXPECT_EQ(directions, expected);
    for (std::size_t count = 0; count < 20; ++count) {
      std::vector<float> few(count);
      FindDirectionsDeg(std::span(moments).first(count), few);
      EXPECT_TRUE(std::equal(few.begin(), few.end(), expected.begin()));
    }
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
