// SPDX-License-Identifier: MIT
#include "orb/kernels/bit_columns.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

/// Returns random numbers. Every other number is its own index, thus the same for all seeds.
std::vector<std::uint16_t> RandomNumbers(int count, unsigned seed) {
  std::vector<std::uint16_t> numbers(count);
  std::memcpy(numbers.data(), test::RandomBytes(2 * count, seed).data(), 2 * count);
  for (int i = 0; i < count; i += 2) numbers[i] = static_cast<std::uint16_t>(i);
  return numbers;
}

std::vector<std::uint64_t> RandomWords(int count, unsigned seed) {
  std::vector<std::uint64_t> words(count);
  if (count > 0) std::memcpy(words.data(), test::RandomBytes(8 * count, seed).data(), 8 * count);
  return words;
}

TEST(CompareRowsTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int count = 1; count < 300; ++count) {
      const auto p = RandomNumbers(count, 2 * count);
      const auto q = RandomNumbers(count, 2 * count + 1);
      const int num_words = (count + 63) / 64;
      std::vector<std::uint64_t> words(num_words + 1, 7);
      std::vector<std::uint64_t> expected = words;
      CompareRows(p.data(), q.data(), count, words.data());
      scalar::CompareRows(p.data(), q.data(), count, expected.data());
      ASSERT_EQ(words, expected) << count << " numbers";
    }
  });
}

TEST(CompareRowsTest, BitsAreInOrderAndPaddingIsZero) {
  std::vector<std::uint16_t> p(70, 5);
  std::vector<std::uint16_t> q(70, 5);
  q[0] = 6;
  q[3] = 65535;
  q[4] = 4;
  q[65] = 6;
  std::vector<std::uint64_t> words(2, ~std::uint64_t{0});
  test::ForEveryInstructionSet([&] {
    CompareRows(p.data(), q.data(), 70, words.data());
    EXPECT_EQ(words, (std::vector<std::uint64_t>{0b1001, 0b10}));
  });
}

TEST(CountDifferencesTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int count = 0; count < 100; ++count) {
      const auto a = RandomWords(count, 2 * count);
      const auto b = RandomWords(count, 2 * count + 1);
      ASSERT_EQ(CountDifferences(a.data(), b.data(), count),
                scalar::CountDifferences(a.data(), b.data(), count));
    }
  });
}

TEST(CountDifferencesTest, CountsEveryBit) {
  const std::vector<std::uint64_t> zeros(1000, 0);
  const std::vector<std::uint64_t> ones(1000, ~std::uint64_t{0});
  test::ForEveryInstructionSet([&] {
    EXPECT_EQ(CountDifferences(zeros.data(), ones.data(), 1000), 64000);
    EXPECT_EQ(CountDifferences(ones.data(), ones.data(), 1000), 0);
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
