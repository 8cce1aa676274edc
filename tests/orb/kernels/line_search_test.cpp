#include "orb/kernels/line_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Points {
  template <typename Search>
  std::vector<int> Find(const Search& search, const Line& line) const {
    std::vector<int> found(x.size());
    const int count = static_cast<int>(x.size());
    found.resize(
        search({x.data(), y.data(), max_squared_distances.data(), count}, line, found.data()));
    return found;
  }

  std::vector<double> x, y, max_squared_distances;
};

TEST(FindNearLineTest, IsItsScalarTwin) {
  test::ForEveryInstructionSet([] {
    for (int count = 0; count < 100; ++count) {
      Points points;
      const auto bytes = test::RandomBytes(3 * static_cast<std::size_t>(count), count);
      for (int i = 0; i < count; ++i) {
        points.x.push_back(bytes[3 * i] / 100.0);
        points.y.push_back(bytes[3 * i + 1] / 100.0);
        points.max_squared_distances.push_back(bytes[3 * i + 2] / 1000.0);
      }
      for (const Line& line : {Line{1, 2, -3}, Line{-0.1, 0.05, 0.1}, Line{0, 0, 0}}) {
        ASSERT_EQ(points.Find(FindNearLine, line), points.Find(scalar::FindNearLine, line))
            << count << " points";
      }
    }
  });
}

TEST(FindNearLineTest, DistanceIsFromTheLineWhateverItsScale) {
  const Points points = {{0, 1, 2, 3}, {0, 1, 0, -1}, {4, 4, 4, 3.99}};
  test::ForEveryInstructionSet([&] {
    for (const double scale : {1.0, 0.5, -4.0}) {  // y = 2
      EXPECT_THAT(points.Find(FindNearLine, {0, scale, -2 * scale}), ElementsAre(0, 1, 2));
    }
    EXPECT_THAT(points.Find(FindNearLine, {0, 1, 3}), ElementsAre());
    EXPECT_THAT(points.Find(FindNearLine, {0, 1, 2.5}), ElementsAre(3));
    EXPECT_THAT(Points().Find(FindNearLine, {0, 1, 0}), IsEmpty());
  });
}

}  // namespace
}  // namespace corvo::orb::kernels
