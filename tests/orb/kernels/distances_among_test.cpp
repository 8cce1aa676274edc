// SPDX-License-Identifier: MIT
#include "orb/kernels/distances_among.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/orb/kernels/descriptors.h"

namespace corvo::orb::kernels {
namespace {

using test::FilledDescriptor;
using test::RandomDescriptors;
using testing::ElementsAre;

using Descriptors = std::vector<Descriptor>;
using Indices = std::vector<std::uint32_t>;

std::vector<std::uint16_t> Find(const Descriptor& query, const Descriptors& train,
                                const Indices& among) {
  std::vector<std::uint16_t> distances(among.size());
  FindDistancesAmong(query, train.data(), among.data(), static_cast<int>(among.size()),
                     distances.data());
  return distances;
}

TEST(FindDistancesAmongTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    const Descriptors train = RandomDescriptors(100, 1);
    const Descriptor query = RandomDescriptors(1, 2).front();
    std::mt19937 random(3);
    for (int count = 0; count < 120; ++count) {
      Indices among(count);
      for (auto& index : among) index = random() % 100;
      std::vector<std::uint16_t> expected(count);
      scalar::FindDistancesAmong(query, train.data(), among.data(), count, expected.data());
      ASSERT_EQ(Find(query, train, among), expected) << count;
    }
  });
}

TEST(FindDistancesAmongTest, CountsBitsThatDiffer) {
  test::ForEveryInstructionSet([] {
    const Descriptors train = {FilledDescriptor(0), FilledDescriptor(0xff), FilledDescriptor(3)};
    EXPECT_THAT(Find(FilledDescriptor(1), train, {2, 0, 1, 2}), ElementsAre(32, 32, 224, 32));
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
