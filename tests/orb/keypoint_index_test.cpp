// SPDX-License-Identifier: MIT
#include "orb/keypoint_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Keypoint> RandomKeypoints(int count, float min, float max, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Keypoint> keypoints(count);
  for (auto& keypoint : keypoints) {
    keypoint.x = static_cast<float>(random.Uniform(min, max));
    keypoint.y = static_cast<float>(random.Uniform(min, max));
    keypoint.octave = random.UniformInt(0, 7);
  }
  return keypoints;
}

std::vector<int> NaiveFind(const std::vector<Keypoint>& keypoints, float x, float y, float radius,
                           int min_octave, int max_octave) {
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(keypoints.size()); ++i) {
    const Keypoint& keypoint = keypoints[i];
    const double dx = double{keypoint.x} - x, dy = double{keypoint.y} - y;
    const bool near = dx * dx + dy * dy <= double{radius} * radius;
    if (near && keypoint.octave >= min_octave && keypoint.octave <= max_octave) found.push_back(i);
  }
  return found;
}

std::vector<int> Find(const KeypointIndex& index, float x, float y, float radius,
                      int min_octave = 0, int max_octave = 7) {
  std::vector<int> found;
  index.Find({x, y, radius, min_octave, max_octave}, found);
  return found;
}

TEST(KeypointIndexTest, FindsWhatABruteForceSearchFinds) {
  test::Random random(1);
  for (const float cell_size : {0.5F, 5.0F, 24.0F, 1e4F}) {
    const auto keypoints = RandomKeypoints(800, -100, 700, 2);
    const KeypointIndex index(keypoints, cell_size);
    for (int run = 0; run < 300; ++run) {
      const auto x = static_cast<float>(random.Uniform(-200, 800));
      const auto y = static_cast<float>(random.Uniform(-200, 800));
      const auto radius = static_cast<float>(random.Uniform(0, 150));
      const int min_octave = random.UniformInt(0, 7), max_octave = random.UniformInt(0, 7);
      EXPECT_EQ(Find(index, x, y, radius, min_octave, max_octave),
                NaiveFind(keypoints, x, y, radius, min_octave, max_octave));
    }
  }
}

TEST(KeypointIndexTest, RadiusIncludesItsBoundary) {
  const std::vector<Keypoint> keypoints = {{.x = 3, .y = 4}, {.x = 5.01F, .y = 0}};
  const KeypointIndex index(keypoints);
  EXPECT_THAT(Find(index, 0, 0, 5), ElementsAre(0));
  EXPECT_THAT(Find(index, 3, 4, 0), ElementsAre(0));
  EXPECT_THAT(Find(index, 0, 0, -1), IsEmpty());
}

TEST(KeypointIndexTest, OctaveRangeIsInclusive) {
  const std::vector<Keypoint> keypoints = {{.octave = 0}, {.octave = 1}, {.octave = 2}};
  const KeypointIndex index(keypoints);
  EXPECT_THAT(Find(index, 0, 0, 1, 1, 2), ElementsAre(1, 2));
  EXPECT_THAT(Find(index, 0, 0, 1, 2, 1), IsEmpty());
}

TEST(KeypointIndexTest, AppendsInAscendingOrder) {
  const std::vector<Keypoint> keypoints = {{.x = 90}, {.x = 0}, {.x = 45}};
  std::vector<int> found = {7};
  KeypointIndex(keypoints).Find({45, 0, 60, 0, 0}, found);
  EXPECT_THAT(found, ElementsAre(7, 0, 1, 2));
}

TEST(KeypointIndexTest, FindUnorderedReturnsTheSameIndicesInAnyOrder) {
  const KeypointIndex index(RandomKeypoints(800, 0, 700, 4));
  std::vector<int> found = {900};
  index.FindUnordered({300, 300, 200, 2, 5}, found);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found.back(), 900);
  found.pop_back();
  EXPECT_EQ(found, Find(index, 300, 300, 200, 2, 5));
}

TEST(KeypointIndexTest, KeypointsMayLieFarApart) {
  const std::vector<Keypoint> keypoints = {{.x = -1e9F, .y = 3}, {.x = 0, .y = 3}, {.x = 1e9F}};
  const KeypointIndex index(keypoints, 1);
  EXPECT_THAT(Find(index, 0, 0, 4), ElementsAre(1));
  EXPECT_THAT(Find(index, 1e9F, 0, 4), ElementsAre(2));
  EXPECT_THAT(Find(index, 0, 0, 3e9F), ElementsAre(0, 1, 2));
}

TEST(KeypointIndexTest, EmptyIndexFindsNothing) {
  EXPECT_THAT(Find(KeypointIndex(), 0, 0, 100), IsEmpty());
  EXPECT_THAT(Find(KeypointIndex(std::vector<Keypoint>{}), 0, 0, 100), IsEmpty());
}

TEST(KeypointIndexTest, NanQueryFindsNothing) {
  const KeypointIndex index(RandomKeypoints(10, 0, 100, 3));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(Find(index, nan, 0, 100), IsEmpty());
  EXPECT_THAT(Find(index, 0, 0, nan), IsEmpty());
}

TEST(KeypointIndexTest, ThrowsOnNonFiniteKeypointsAndInvalidCellSize) {
  const std::vector<Keypoint> keypoints = {{}, {.x = std::numeric_limits<float>::infinity()}};
  EXPECT_THAT([&] { KeypointIndex index(keypoints); }, test::ThrowsError("keypoint 1", "finite"));
  EXPECT_THAT([] { KeypointIndex index(std::vector<Keypoint>(1), 0.0F); },
              test::ThrowsError("cell_size_px"));
}

}  // namespace
}  // namespace corvo::orb
