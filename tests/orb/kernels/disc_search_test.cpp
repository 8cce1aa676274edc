// SPDX-License-Identifier: MIT
#include "orb/kernels/disc_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A grid of `columns` by 2 cells with `count` points in arbitrary cells. Coordinates are multiples
/// of a quarter of a pixel in [0, 64); octaves are 0 to 7.
struct Points {
  Points(int count, int num_columns, unsigned seed) : columns(num_columns) {
    const auto bytes = test::RandomBytes(3 * static_cast<std::size_t>(count), seed);
    for (int i = 0; i < count; ++i) {
      x.push_back(static_cast<float>(bytes[3 * i]) / 4);
      y.push_back(static_cast<float>(bytes[3 * i + 1]) / 4);
      octaves.push_back(bytes[3 * i + 2] % 8);
      indices.push_back(1000 - i);
    }
    for (int c = 0; c <= 2 * columns; ++c) cell_starts.push_back(count * c / (2 * columns));
    for (auto* coordinates : {&x, &y}) coordinates->resize(count + kGridPadding);
    for (auto* numbers : {&octaves, &indices}) numbers->resize(count + kGridPadding);
  }

  /// Returns the indices that `search` finds in the cells of columns [first, last].
  template <typename Search>
  std::vector<int> Find(const Search& search, int first, int last, const OctaveDisc& disc) const {
    std::vector<int> found(x.size());
    found.resize(
        search({x.data(), y.data(), octaves.data(), indices.data(), cell_starts.data(), columns},
               {first, last, 0, 1}, disc, found.data()));
    return found;
  }

  int columns;
  std::vector<float> x, y;
  std::vector<int> octaves, indices, cell_starts;
};

TEST(FindInDiscTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (int count = 0; count < 120; ++count) {
      const Points points(count, 3, count);
      for (const double radius : {0.0, 7.0, 20.25, 90.0}) {
        const OctaveDisc disc = {30.1, 20.7, radius, count % 3, 2 + count % 7};
        for (const int first : {0, 1}) {
          ASSERT_EQ(points.Find(FindInDisc, first, 2, disc),
                    points.Find(scalar::FindInDisc, first, 2, disc))
              << count << " points, radius " << radius;
        }
      }
    }
  });
}

TEST(FindInDiscTest, DiscAndOctaveBoundariesAreInclusive) {
  Points points(3, 1, 0);
  points.x = {3, 5, 5.25F};
  points.y = {4, 0, 0};
  points.octaves = {2, 3, 2};
  for (auto* coordinates : {&points.x, &points.y}) coordinates->resize(3 + kGridPadding);
  points.octaves.resize(3 + kGridPadding);
  test::ForEveryInstructionSet([&] {
    EXPECT_THAT(points.Find(FindInDisc, 0, 0, {0, 0, 5, 2, 3}), ElementsAre(1000, 999));
    EXPECT_THAT(points.Find(FindInDisc, 0, 0, {0, 0, 5, 3, 3}), ElementsAre(999));
    EXPECT_THAT(points.Find(FindInDisc, 0, 0, {0, 0, 4.99, 0, 9}), IsEmpty());
    EXPECT_THAT(points.Find(FindInDisc, 0, 0, {0, 0, 6, 3, 2}), IsEmpty());
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
