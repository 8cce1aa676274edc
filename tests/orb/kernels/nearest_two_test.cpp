// SPDX-License-Identifier: MIT
#include "orb/kernels/nearest_two.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/orb/kernels/descriptors.h"

namespace corvo::orb::kernels {

void PrintTo(const Nearest& nearest, std::ostream* out) {
  *out << nearest.index << " at " << nearest.distance << ", " << nearest.second_index << " at "
       << nearest.second_distance;
}

namespace {

using test::FilledDescriptor;
using test::RandomDescriptors;
using test::SimilarDescriptors;
using testing::Each;
using testing::ElementsAre;

using Descriptors = std::vector<Descriptor>;

template <typename Search>
std::vector<Nearest> FindWith(const Search& search, const Descriptors& queries,
                              const Descriptors& train) {
  const auto scratch = std::make_unique<NearestTwoScratch>();
  std::vector<Nearest> nearest(queries.size());
  search(queries, train, *scratch, nearest.data());
  return nearest;
}

std::vector<Nearest> Find(const Descriptors& queries, const Descriptors& train) {
  return FindWith(FindNearestTwo, queries, train);
}

std::vector<Nearest> FindByTwin(const Descriptors& queries, const Descriptors& train) {
  return FindWith(scalar::FindNearestTwo, queries, train);
}

/// Returns numbers of train descriptors around the block sizes of the kernels.
const std::vector<int>& TrainCounts() {
  static const std::vector<int> counts = {
      0,   1,   2,   3,   7,    8,    9,    15,   16,   17,   31,   32,   33,   63,   64,   65,
      127, 128, 129, 500, 1000, 1023, 1024, 1025, 1026, 1087, 1088, 1089, 2047, 2048, 2049, 3100};
  return counts;
}

TEST(FindNearestTwoTest, MatchesTheScalarVersionOnIndependentBits) {
  test::ForEveryInstructionSet([] {
    const auto queries = RandomDescriptors(11, 1);
    for (const int count : TrainCounts()) {
      const auto train = RandomDescriptors(count, 2);
      ASSERT_EQ(Find(queries, train), FindByTwin(queries, train)) << count << " train";
    }
  });
}

TEST(FindNearestTwoTest, MatchesTheScalarVersionOnEqualDistances) {
  test::ForEveryInstructionSet([] {
    const auto queries = SimilarDescriptors(11, 3);
    for (const int count : TrainCounts()) {
      const auto train = SimilarDescriptors(count, 4);
      ASSERT_EQ(Find(queries, train), FindByTwin(queries, train)) << count << " train";
    }
  });
}

TEST(FindNearestTwoTest, MatchesTheScalarVersionForAnyNumberOfQueries) {
  test::ForEveryInstructionSet([] {
    const auto train = RandomDescriptors(70, 5);
    for (int count = 0; count < 20; ++count) {
      const auto queries = RandomDescriptors(count, 6);
      ASSERT_EQ(Find(queries, train), FindByTwin(queries, train)) << count << " queries";
    }
  });
}

TEST(FindNearestTwoTest, EqualDescriptorsResolveToTheFirstTwo) {
  test::ForEveryInstructionSet([] {
    const Descriptors train(2100, FilledDescriptor(0x5a));
    EXPECT_THAT(Find({3, FilledDescriptor(0x5a)}, train), Each(Nearest{0, 0, 0, 1}));
    EXPECT_THAT(Find({3, FilledDescriptor(0x5b)}, train), Each(Nearest{0, 32, 32, 1}));
  });
}

TEST(FindNearestTwoTest, ComplementsAre256Apart) {
  test::ForEveryInstructionSet([] {
    const Descriptors queries = {FilledDescriptor(0), FilledDescriptor(0xff)};
    const Descriptors ones(1500, FilledDescriptor(0xff));
    EXPECT_THAT(Find(queries, ones), ElementsAre(Nearest{0, 256, 256, 1}, Nearest{0, 0, 0, 1}));
    EXPECT_THAT(Find(queries, {FilledDescriptor(0)}),
                ElementsAre(Nearest{0, 0, 257, -1}, Nearest{0, 256, 257, -1}));
  });
}

TEST(FindNearestTwoTest, FindsTheNearestAtAnyIndex) {
  test::ForEveryInstructionSet([] {
    for (int index = 0; index < 2100; index += 1 + index / 40) {
      Descriptors train(2100, FilledDescriptor(0xff));
      train[index] = FilledDescriptor(0x01);
      train[2099 - index / 2] = FilledDescriptor(0x03);
      const Descriptors queries = {FilledDescriptor(0)};
      ASSERT_THAT(Find(queries, train), ElementsAre(Nearest{index, 32, 64, 2099 - index / 2}));
    }
  });
}

TEST(FindNearestTwoTest, UpdatesAnEarlierResult) {
  test::ForEveryInstructionSet([] {
    const Descriptors train = {FilledDescriptor(1), FilledDescriptor(3)};
    const Descriptors queries = {FilledDescriptor(0)};
    const auto scratch = std::make_unique<NearestTwoScratch>();
    Nearest nearest = {7, 40, 50, 8};
    FindNearestTwo(queries, train, *scratch, &nearest);
    EXPECT_EQ(nearest, (Nearest{0, 32, 40, 7}));
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
