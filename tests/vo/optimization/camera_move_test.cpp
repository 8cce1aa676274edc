// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_move.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"

namespace corvo {
namespace {

constexpr int kNumMoved = 12;

Camera BentCamera(double k1) {
  CameraParameters parameters = test::PinholeCamera().parameters();
  parameters.k1 = k1;
  return Camera(parameters);
}

/// Returns options with which only few points are adjusted jointly.
AdjustmentOptions FewPoints() {
  AdjustmentOptions options;
  options.points_per_view = 20;
  return options;
}

double SumOfErrors(const Camera& camera, Bundle bundle) {
  double sum = 0;
  VisitErrors(camera, bundle, [&](Bundle::Observation&, double error) { sum += error; });
  return sum;
}

TEST(CameraMoveTest, NoiseOfTheObservationsHasNoPart) {
  test::Random random(1);
  const Camera camera = test::PinholeCamera();
  Bundle exact = test::MakeObservedBundle(camera, kNumMoved, 0, random);
  Bundle noisy = exact;
  for (Bundle::Observation& observation : noisy.observations) {
    observation.pixel += random.Vector<2>(0.5);
  }
  const Camera after = BentCamera(0.002);
  ASSERT_TRUE(IsUsable(MoveToCamera(camera, after, FewPoints(), exact)));
  ASSERT_TRUE(IsUsable(MoveToCamera(camera, after, FewPoints(), noisy)));
  for (int i = 0; i < kNumMoved; ++i) {
    EXPECT_EQ(noisy.views[i].local_from_camera, exact.views[i].local_from_camera) << i;
  }
}

TEST(CameraMoveTest, TheNewCameraSeesThePointsMoreAlike) {
  test::Random random(2);
  const Camera camera = test::PinholeCamera();
  const Bundle before = test::MakeObservedBundle(camera, kNumMoved, 0, random);
  Bundle moved = before;
  const Camera after = BentCamera(0.002);
  ASSERT_TRUE(IsUsable(MoveToCamera(camera, after, FewPoints(), moved)));
  EXPECT_LT(SumOfErrors(after, moved), 0.5 * SumOfErrors(after, before));
}

TEST(CameraMoveTest, ThereAndBackIsAsBefore) {
  test::Random random(3);
  const Camera camera = test::PinholeCamera(), after = BentCamera(0.002);
  const Bundle before = test::MakeObservedBundle(camera, kNumMoved, 0.5, random);
  Bundle moved = before;
  ASSERT_TRUE(IsUsable(MoveToCamera(camera, after, FewPoints(), moved)));
  const Bundle there = moved;
  ASSERT_TRUE(IsUsable(MoveToCamera(after, camera, FewPoints(), moved)));
  const SE3 middle = before.views[kNumMoved / 2].Pose();
  const auto distance = [&](const Bundle& bundle) {
    return (bundle.views[kNumMoved / 2].Pose().Inverse() * middle).Log().norm();
  };
  EXPECT_GT(distance(there), 1e-3);
  EXPECT_LT(distance(moved), 0.05 * distance(there));
}

TEST(CameraMoveTest, OutliersAreThoseOfTheObservations) {
  test::Random random(4);
  const Camera camera = test::PinholeCamera();
  Bundle bundle = test::MakeObservedBundle(camera, kNumMoved, 0.1, random);
  bundle.observations[7].pixel.x() += 5;
  ASSERT_TRUE(IsUsable(MoveToCamera(camera, camera, FewPoints(), bundle)));
  EXPECT_FALSE(bundle.observations[7].is_inlier);
  EXPECT_TRUE(bundle.observations[8].is_inlier);
}

}  // namespace
}  // namespace corvo
