// SPDX-License-Identifier: MIT
#include "orb/lsh_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "orb/hamming.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo::orb {

void PrintTo(const Neighbor& neighbor, std::ostream* out) {
  *out << neighbor.index << " at " << neighbor.distance;
}

namespace {

using test::ThrowsError;
using testing::ElementsAre;
using testing::IsEmpty;

using Descriptors = std::vector<Descriptor>;

/// Options with which a query probes every key of every table.
constexpr LshIndexOptions kExact = {.num_tables = 3, .max_flips = 21, .recall = 1};

/// Returns descriptors in which each bit equals its neighbor in the byte with probability 3/4, so
/// that keys are not uniform.
Descriptors DependentBits(int count, std::uint64_t seed) {
  test::Random random(seed);
  Descriptors descriptors(count);
  for (Descriptor& descriptor : descriptors) {
    for (std::uint8_t& byte : descriptor.bytes) {
      unsigned bits = static_cast<unsigned>(random.Bits()) & 1;
      for (int i = 1; i < 8; ++i) {
        const unsigned flip = random.UniformInt(0, 3) == 0;
        bits = bits << 1 | ((bits & 1) ^ flip);
      }
      byte = static_cast<std::uint8_t>(bits);
    }
  }
  return descriptors;
}

Descriptor FlipBits(Descriptor descriptor, int count, test::Random& random) {
  std::set<int> bits;
  while (static_cast<int>(bits.size()) < count) bits.insert(random.UniformInt(0, 255));
  for (const int bit : bits) descriptor.bytes[bit / 8] ^= 1 << (bit % 8);
  return descriptor;
}

std::vector<Neighbor> NaiveNearest(const Descriptors& descriptors, const Descriptor& query, int k) {
  std::vector<Neighbor> all;
  for (int i = 0; i < static_cast<int>(descriptors.size()); ++i) {
    all.push_back({HammingDistance(query, descriptors[i]), i});
  }
  std::sort(all.begin(), all.end());
  if (static_cast<int>(all.size()) > k) all.resize(k);
  return all;
}

void ExpectExact(const LshIndex& index, const Descriptors& descriptors, int k) {
  test::Random random(7);
  for (int run = 0; run < 30; ++run) {
    const Descriptor& near =
        descriptors[random.UniformInt(0, static_cast<int>(descriptors.size()) - 1)];
    const Descriptor query = FlipBits(near, 5 * run, random);
    ASSERT_EQ(index.FindNearest(query, k), NaiveNearest(descriptors, query, k)) << run;
  }
}

TEST(LshIndexTest, IsExactIfProbesCoverAllKeys) {
  const Descriptors descriptors = DependentBits(6000, 1);
  const LshIndex index(descriptors, kExact);
  ASSERT_GT(index.bits_a_key(), 0);
  for (const int k : {1, 2, 10}) ExpectExact(index, descriptors, k);
}

TEST(LshIndexTest, IsExactOnFewDescriptorsForAnyOptions) {
  const Descriptors descriptors = DependentBits(1000, 2);
  const LshIndex index(descriptors, {.num_tables = 1, .max_flips = 0, .recall = 0});
  EXPECT_EQ(index.bits_a_key(), 0);
  for (const int k : {1, 3, 2000}) ExpectExact(index, descriptors, k);
}

TEST(LshIndexTest, EqualDescriptorsAreReturnedInIndexOrder) {
  Descriptors descriptors = DependentBits(9000, 3);
  const Descriptor twin = descriptors[4000];
  descriptors[100] = descriptors[8000] = twin;
  const LshIndex index(descriptors);
  EXPECT_THAT(index.FindNearest(twin, 2), ElementsAre(Neighbor{0, 100}, Neighbor{0, 4000}));
  EXPECT_EQ(index.FindNearest(twin, 3).back(), (Neighbor{0, 8000}));
}

TEST(LshIndexTest, FindsMostNearestAmongManyWithFlippedBits) {
  test::Random random(4);
  const Descriptors descriptors = DependentBits(60000, 5);
  const LshIndex index(descriptors);
  int found = 0;
  constexpr int kQueries = 400;
  for (int run = 0; run < kQueries; ++run) {
    const int source = random.UniformInt(0, index.size() - 1);
    const Descriptor query = FlipBits(descriptors[source], random.UniformInt(25, 50), random);
    const std::vector<Neighbor> nearest = index.FindNearest(query, 1);
    found += nearest.size() == 1 && nearest[0].index == source;
  }
  EXPECT_GE(found, 0.95 * kQueries);
}

TEST(LshIndexTest, HigherRecallFindsMore) {
  const Descriptors descriptors = DependentBits(30000, 6);
  int last = 0;
  for (const double recall : {0.0, 0.3, 0.99}) {
    const LshIndex index(descriptors, {.num_tables = 4, .max_flips = 3, .recall = recall});
    test::Random random(8);
    int found = 0;
    for (int run = 0; run < 200; ++run) {
      const int source = random.UniformInt(0, index.size() - 1);
      const Descriptor query = FlipBits(descriptors[source], 45, random);
      const std::vector<Neighbor> nearest = index.FindNearest(query, 1);
      found += !nearest.empty() && nearest[0].index == source;
    }
    EXPECT_GT(found, last) << recall;
    last = found;
  }
  EXPECT_GE(last, 190);
}

TEST(LshIndexTest, DistancesAreExactAndSorted) {
  test::Random random(9);
  const Descriptors descriptors = DependentBits(20000, 10);
  const LshIndex index(descriptors);
  for (int run = 0; run < 50; ++run) {
    const Descriptor query = FlipBits(descriptors[run], 40, random);
    const std::vector<Neighbor> nearest = index.FindNearest(query, 5);
    EXPECT_TRUE(std::is_sorted(nearest.begin(), nearest.end()));
    EXPECT_EQ(std::adjacent_find(nearest.begin(), nearest.end()), nearest.end());
    for (const Neighbor& neighbor : nearest) {
      EXPECT_EQ(neighbor.distance, HammingDistance(query, descriptors[neighbor.index]));
    }
  }
}

TEST(LshIndexTest, AddedDescriptorsAreFound) {
  const Descriptors descriptors = DependentBits(14000, 11);
  const std::span<const Descriptor> all(descriptors);
  LshIndex index(kExact);
  for (std::size_t first = 0; first < descriptors.size(); first += 700) {
    index.Add(all.subspan(first, 700));
    const Descriptors so_far(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first) + 700);
    ASSERT_EQ(index.size(), static_cast<int>(so_far.size()));
    ExpectExact(index, so_far, 2);
  }
}

TEST(LshIndexTest, EmptyIndexFindsNothing) {
  EXPECT_THAT(LshIndex().FindNearest({}, 3), IsEmpty());
  EXPECT_THAT(LshIndex(Descriptors()).FindNearest({}, 3), IsEmpty());
}

TEST(LshIndexTest, IdenticalDescriptorsAreFound) {
  const LshIndex index(Descriptors(10000, Descriptor()));
  EXPECT_THAT(index.FindNearest({}, 2), ElementsAre(Neighbor{0, 0}, Neighbor{0, 1}));
}

TEST(LshIndexTest, ReturnsItsDescriptorsAndItsMemoryUse) {
  const Descriptors descriptors = DependentBits(5000, 12);
  const LshIndex index(descriptors, {.num_tables = 4});
  EXPECT_EQ(index.descriptor(4321), descriptors[4321]);
  const std::size_t tables = 4 * (5000 + (std::size_t{1} << index.bits_a_key()) + 1);
  EXPECT_EQ(index.memory_bytes(), 5000 * sizeof(Descriptor) + 4 * tables);
}

TEST(LshIndexTest, ThrowsOnOptionsOutOfRange) {
  EXPECT_THAT([] { LshIndex({.num_tables = 0}); }, ThrowsError("num_tables is 0"));
  EXPECT_THAT([] { LshIndex({.num_tables = 13}); }, ThrowsError("num_tables is 13"));
  EXPECT_THAT([] { LshIndex({.max_flips = -1}); }, ThrowsError("max_flips is -1"));
  EXPECT_THAT([] { LshIndex({.recall = 1.1}); }, ThrowsError("recall is 1.1"));
  EXPECT_THAT([] { LshIndex().FindNearest({}, 0); }, ThrowsError("k is 0"));
}

class LshIndexFileTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return dir_.path() / "index"; }

  /// Returns the contents of the file that an index of `count` descriptors writes.
  std::string Written(int count) const {
    LshIndex(DependentBits(count, 13)).Save(file());
    return test::ReadText(file());
  }

  LshIndex Load(const std::string& text) const { return LshIndex::Load(dir_.Write("x", text)); }

  test::TemporaryFolder dir_;
};

TEST_F(LshIndexFileTest, LoadedIndexEqualsTheSavedOne) {
  const Descriptors descriptors = DependentBits(30000, 14);
  for (const int count : {0, 5, 4096, 4097, 29900}) {
    LshIndex index(std::span<const Descriptor>(descriptors).first(count),
                   {.num_tables = 5, .recall = 0.7});
    index.Add(std::span(descriptors).last(100));
    index.Save(file());
    const LshIndex loaded = LshIndex::Load(file());
    ASSERT_EQ(loaded.size(), count + 100);
    EXPECT_EQ(loaded.options(), index.options());
    EXPECT_EQ(loaded.bits_a_key(), index.bits_a_key());
    test::Random random(15);
    for (int run = 0; run < 100; ++run) {
      const Descriptor query = FlipBits(descriptors[random.UniformInt(0, 29999)], 40, random);
      ASSERT_EQ(loaded.FindNearest(query, 3), index.FindNearest(query, 3));
    }
    const std::string first = test::ReadText(file());
    loaded.Save(file());
    EXPECT_EQ(test::ReadText(file()), first);
  }
}

TEST_F(LshIndexFileTest, DescriptorsCanBeAddedToALoadedIndex) {
  const Descriptors descriptors = DependentBits(9000, 16);
  LshIndex(std::span<const Descriptor>(descriptors).first(5000), kExact).Save(file());
  LshIndex index = LshIndex::Load(file());
  index.Add(std::span(descriptors).last(4000));
  ExpectExact(index, descriptors, 2);
}

TEST_F(LshIndexFileTest, EveryTruncationThrows) {
  const std::string text = Written(3);
  Load(text);
  for (std::size_t size = 0; size < text.size(); ++size) {
    ASSERT_THAT([&] { Load(text.substr(0, size)); }, ThrowsError("x: ")) << size;
  }
  EXPECT_THAT([&] { Load(text + '\0'); }, ThrowsError("size in bytes"));
}

TEST_F(LshIndexFileTest, EveryDamagedByteThrows) {
  const std::string text = Written(3);
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const unsigned mask : {0x01U, 0x80U}) {
      std::string damaged = text;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ mask);
      ASSERT_THAT([&] { Load(damaged); }, ThrowsError("x: ")) << "byte " << i << ", mask " << mask;
    }
  }
}

TEST_F(LshIndexFileTest, DamageInALargeFileThrows) {
  const std::string text = Written(5000);
  for (std::size_t i = 0; i < text.size(); i += i < 400 ? 1 : 7919) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] + 1);
    ASSERT_THAT([&] { Load(damaged); }, ThrowsError("x: ")) << i;
  }
}

/// Returns the text with this word at a byte and with the checksum that fits.
std::string WithWord(std::string text, std::size_t byte, std::uint64_t word) {
  std::memcpy(text.data() + byte, &word, sizeof(word));
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::size_t i = 0; i + sizeof(sum) < text.size(); i += sizeof(word)) {
    std::memcpy(&word, text.data() + i, sizeof(word));
    sum = (sum ^ word) * 0x100000001b3;
  }
  std::memcpy(text.data() + text.size() - sizeof(sum), &sum, sizeof(sum));
  return text;
}

TEST_F(LshIndexFileTest, KeysOutOfProportionToTheDescriptorsThrow) {
  constexpr std::size_t kBitsAKey = 56;  // Where the head holds them.
  const std::string text = Written(5000);
  EXPECT_EQ(Load(WithWord(text, kBitsAKey, 10)).bits_a_key(), 10);
  for (const std::uint64_t bits : {0, 1, 9, 11, 21}) {
    EXPECT_THAT([&] { Load(WithWord(text, kBitsAKey, bits)); }, ThrowsError("x: bits a key"));
  }
}

TEST_F(LshIndexFileTest, ErrorsNameFilesThatCannotBeReadOrWritten) {
  EXPECT_THAT([&] { LshIndex::Load(dir_.path() / "none"); }, ThrowsError("none: cannot be read"));
  EXPECT_THAT([&] { LshIndex::Load(dir_.path()); }, ThrowsError("cannot be read"));
  EXPECT_THAT([&] { Load(std::string(1000, 'a')); }, ThrowsError("is no index"));
  EXPECT_THAT([&] { LshIndex().Save(dir_.path() / "no" / "such"); },
              ThrowsError("cannot be written"));
}

}  // namespace
}  // namespace corvo::orb
