// SPDX-License-Identifier: MIT
#include "vo/mapping/ray_grid.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "tests/support/random.h"
#include "vo/math/chi_square.h"

namespace corvo {
namespace {

UnmatchedKeypoints RandomPoints(int count, test::Random& random) {
  UnmatchedKeypoints points;
  for (int i = 0; i < count; ++i) {
    points.index.push_back(i);
    points.descriptors.emplace_back();
    points.x.push_back(random.Uniform(-0.8, 0.8));
    points.y.push_back(random.Uniform(-0.6, 0.6));
    const double sigma = random.Uniform(0.001, 0.004);
    points.variances.push_back(sigma * sigma);
    points.octave_scales.push_back(1);
  }
  return points;
}

EpipolarSegment SegmentBetween(const Eigen::Vector2d& near, const Eigen::Vector2d& far) {
  const Eigen::Vector2d along = (far - near).normalized();
  const Eigen::Vector2d normal(-along.y(), along.x());
  return {near, far, {normal.x(), normal.y(), -normal.dot(near)}};
}

bool IsNearLine(const UnmatchedKeypoints& points, int i, const EpipolarSegment& segment) {
  const double distance = segment.line.dot(Eigen::Vector3d(points.x[i], points.y[i], 1));
  return distance * distance <= kChiSquare1Dof95 * points.variances[i];
}

bool IsBesideSegment(const UnmatchedKeypoints& points, int i, const EpipolarSegment& segment) {
  const Eigen::Vector2d along = segment.far - segment.near;
  const double t = along.dot(Eigen::Vector2d(points.x[i], points.y[i]) - segment.near);
  return t >= 0 && t <= along.squaredNorm();
}

TEST(RayGridTest, FindsEveryPointBesideASegmentAndOnlyPointsNearItsLine) {
  test::Random random(5);
  const RayGrid grid(RandomPoints(3000, random), 0.05);
  const UnmatchedKeypoints& points = grid.points();
  std::vector<int> buffer(static_cast<std::size_t>(points.size()) + 1);
  int num_beside = 0;
  for (int n = 0; n < 300; ++n) {
    const Eigen::Vector2d near{random.Uniform(-1, 1), random.Uniform(-1, 1)};
    Eigen::Vector2d far{random.Uniform(-1, 1), random.Uniform(-1, 1)};
    if (n % 5 == 0) far.y() = near.y();
    if (n % 5 == 1) far.x() = near.x();
    const EpipolarSegment segment = SegmentBetween(near, far);
    const auto span = grid.Find(segment, buffer);
    const std::set<int> found(span.begin(), span.end());
    EXPECT_EQ(found.size(), span.size()) << "no point is found twice";
    for (int i = 0; i < points.size(); ++i) {
      const bool is_near = IsNearLine(points, i, segment);
      EXPECT_TRUE(is_near || found.count(i) == 0) << n;
      if (!is_near || !IsBesideSegment(points, i, segment)) continue;
      EXPECT_EQ(found.count(i), 1u) << n;
      ++num_beside;
    }
  }
  EXPECT_GT(num_beside, 1000);
}

TEST(RayGridTest, WithoutPointsFindsNone) {
  std::vector<int> buffer(1);
  EXPECT_TRUE(RayGrid({}, 0.05).Find(SegmentBetween({0, 0}, {1, 1}), buffer).empty());
}

}  // namespace
}  // namespace corvo
