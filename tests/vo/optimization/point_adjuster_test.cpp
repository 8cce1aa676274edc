// SPDX-License-Identifier: MIT
#include "vo/optimization/point_adjuster.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/math/huber.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

/// Makes a bundle of six views along x without noise, the first of them fixed.
Bundle MakeBundle(test::Random& random) {
  const test::PointScene scene = test::MakeBoxScene(300, 3, 10, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < 6; ++i) {
    const SE3 pose(SO3(), Eigen::Vector3d(0.4 * i, 0, 0));
    views.push_back(test::ObserveScene(scene, test::PinholeCamera(), pose, 0, random));
  }
  const Map map = test::MakeMap(scene, views);
  return CopyBundle(map, {{1, 2, 3, 4, 5}, {0}, map.FindObserved({1, 2, 3, 4, 5})});
}

std::vector<int> CountObservations(const Bundle& bundle) {
  std::vector<int> counts(bundle.points.size(), 0);
  for (const Bundle::Observation& observation : bundle.observations) ++counts[observation.point];
  return counts;
}

TEST(PointAdjusterTest, OtherPointsReturnToTheirTruePositions) {
  test::Random random(1);
  const Bundle exact = MakeBundle(random);
  Bundle bundle = exact;
  std::vector<char> is_adjusted(bundle.points.size(), 0);
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    is_adjusted[i] = i % 2 == 0;
    bundle.points[i].in_local += random.Vector<3>(0.1);
  }
  const Bundle disturbed = bundle;
  AdjustPoints(test::PinholeCamera(), is_adjusted, {}, bundle);
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    if (is_adjusted[i]) {
      EXPECT_EQ(bundle.points[i].in_local, disturbed.points[i].in_local);
    } else {
      EXPECT_THAT(bundle.points[i].in_local, test::IsMatrixNear(exact.points[i].in_local, 1e-2));
    }
  }
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    EXPECT_EQ(bundle.views[i].local_from_camera, exact.views[i].local_from_camera);
  }
}

TEST(PointSelectionTest, EveryFreeViewHasItsQuota) {
  test::Random random(2);
  const Bundle bundle = MakeBundle(random);
  constexpr int kPointsPerView = 20;
  const std::vector<char> is_selected = SelectPoints(bundle, kPointsPerView);
  std::vector<int> num_selected(bundle.views.size(), 0), num_seen(bundle.views.size(), 0);
  for (const Bundle::Observation& observation : bundle.observations) {
    num_selected[observation.view] += is_selected[observation.point];
    ++num_seen[observation.view];
  }
  for (std::size_t view = 1; view < bundle.views.size(); ++view) {
    EXPECT_GE(num_selected[view], std::min(kPointsPerView, num_seen[view])) << view;
  }
  EXPECT_LT(std::count(is_selected.begin(), is_selected.end(), 1),
            5 * kPointsPerView);  // Fewer than the sum of the quotas: views share points.
}

TEST(PointSelectionTest, LongTracksAreSelectedFirst) {
  test::Random random(3);
  const Bundle bundle = MakeBundle(random);
  const std::vector<char> is_selected = SelectPoints(bundle, 1);
  const std::vector<int> counts = CountObservations(bundle);
  const auto longest = std::max_element(counts.begin(), counts.end());
  EXPECT_TRUE(is_selected[longest - counts.begin()]);
}

TEST(PointSelectionTest, AQuotaThatNoViewFillsSelectsAllPoints) {
  test::Random random(4);
  const Bundle bundle = MakeBundle(random);
  EXPECT_THAT(SelectPoints(bundle, 100000), ::testing::Each(1));
}

TEST(ThinPointsTest, KeepsTheLongestTracksOfEveryView) {
  Bundle bundle;
  bundle.views.resize(4);
  const std::vector<std::vector<int>> tracks = {{0, 1}, {0, 1, 2}, {1, 2}, {3}, {2, 3}, {0, 1}};
  for (int point = 0; point < 6; ++point) {
    bundle.points.push_back({10 + point, Eigen::Vector3d::Zero()});
    for (const int view : tracks[point])
      bundle.observations.push_back({{10 + point, kNoId, Eigen::Vector2d::Zero(), 1}, view, point});
  }
  const auto kept = [&](int max_points) {
    const Bundle thinned = ThinPoints(bundle, max_points);
    std::vector<LandmarkId> landmarks;
    for (const Bundle::Point& point : thinned.points) landmarks.push_back(point.landmark);
    for (const Bundle::Observation& observation : thinned.observations) {
      const std::vector<int>& track = tracks[thinned.points[observation.point].landmark - 10];
      EXPECT_THAT(track, testing::Contains(observation.view));
    }
    return landmarks;
  };
  EXPECT_THAT(kept(1), testing::ElementsAre(11, 14));
  EXPECT_THAT(kept(2), testing::ElementsAre(10, 11, 12, 14));
  EXPECT_THAT(kept(9), testing::ElementsAre(10, 11, 12, 14, 15));
}

TEST(HuberLossTest, IsQuadraticThenLinear) {
  EXPECT_EQ(HuberLoss(3, 4).value, 3);
  EXPECT_EQ(HuberLoss(3, 4).weight, 1);
  EXPECT_DOUBLE_EQ(HuberLoss(16, 4).value, 2 * 2 * 4 - 4);
  EXPECT_DOUBLE_EQ(HuberLoss(16, 4).weight, 0.5);
}

}  // namespace
}  // namespace corvo
