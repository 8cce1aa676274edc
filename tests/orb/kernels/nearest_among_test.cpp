// SPDX-License-Identifier: MIT
#include "orb/kernels/nearest_among.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/orb/kernels/descriptors.h"

namespace corvo::orb::kernels {
namespace {

using test::FilledDescriptor;
using test::RandomDescriptors;
using test::SimilarDescriptors;

using Descriptors = std::vector<Descriptor>;

Nearest FindAmong(const Descriptor& query, const Descriptors& train,
                  const std::vector<int>& among) {
  return FindNearestAmong(query, train.data(), among.data(), static_cast<int>(among.size()));
}

/// Returns every third index below `count`, shuffled.
std::vector<int> SomeIndices(int count) {
  std::vector<int> indices;
  for (int i = 0; i < count; i += 3) indices.push_back(i);
  std::shuffle(indices.begin(), indices.end(), std::mt19937(1));
  return indices;
}

TEST(FindNearestAmongTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int count = 0; count < 100; ++count) {
      const auto among = SomeIndices(count);
      for (const auto& train : {RandomDescriptors(count, 1), SimilarDescriptors(count, 2)}) {
        for (const auto& query : {FilledDescriptor(0), FilledDescriptor(0xff)}) {
          ASSERT_EQ(FindAmong(query, train, among),
                    scalar::FindNearestAmong(query, train.data(), among.data(),
                                             static_cast<int>(among.size())))
              << count;
        }
      }
    }
  });
}

TEST(FindNearestAmongTest, TheOrderOfCandidatesDoesNotMatter) {
  test::ForEveryInstructionSet([] {
    const auto train = SimilarDescriptors(60, 3);
    std::vector<int> among(60);
    std::iota(among.begin(), among.end(), 0);
    const Nearest ascending = FindAmong(train[5], train, among);
    std::reverse(among.begin(), among.end());
    EXPECT_EQ(FindAmong(train[5], train, among), ascending);
  });
}

TEST(FindNearestAmongTest, EqualDistancesGoToTheLowerIndices) {
  test::ForEveryInstructionSet([] {
    const Descriptors train(9, FilledDescriptor(0x11));
    EXPECT_EQ(FindAmong(FilledDescriptor(0x11), train, {8, 4, 2, 6}), (Nearest{2, 0, 0, 4}));
    EXPECT_EQ(FindAmong(FilledDescriptor(0xee), train, {7, 3}), (Nearest{3, 256, 256, 7}));
    EXPECT_EQ(FindAmong(FilledDescriptor(0x10), train, {5}), (Nearest{5, 32, 257, -1}));
    EXPECT_EQ(FindAmong(FilledDescriptor(0x10), train, {}), Nearest{});
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
