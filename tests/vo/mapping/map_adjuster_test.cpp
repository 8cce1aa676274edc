#include "vo/mapping/map_adjuster.h"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {
namespace {

constexpr int kEnd = std::numeric_limits<int>::max();

/// A turning path of views, taken with `taken_with`, each `spacing` frames after the one before;
/// keyframes and landmarks are disturbed.
Map MakeDisturbedMap(int num_views, const Camera& taken_with, test::Random& random,
                     int spacing = 5) {
  const test::PointScene scene = test::MakeBoxScene(600, 3, 12, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < num_views; ++i) {
    const SE3 pose(SO3::Exp({0, 0.03 * i, 0}), Eigen::Vector3d(0.25 * i, 0.05 * (i % 3), 0));
    views.push_back(test::ObserveScene(scene, taken_with, pose, 0.3, random));
    views.back().frame.index = spacing * i;
  }
  Map map = test::MakeMap(scene, views);
  for (KeyframeId id = 1; id < num_views; ++id) {
    map.SetPose(id, map.WorldFromKeyframe(id) * SE3::Exp(random.Vector<6>(0.01)));
  }
  return map;
}

/// As MakeDisturbedMap with 14 views of a camera of this k1, where PinholeCamera has none.
Map MakeDistortedMap(double k1, test::Random& random) {
  CameraParameters true_camera = test::PinholeCamera().parameters();
  true_camera.k1 = k1;
  return MakeDisturbedMap(14, Camera(true_camera), random);
}

OdometryOptions FixedCamera() {
  OdometryOptions options;
  options.calibration.enabled = false;
  return options;
}

MapAdjuster MakeAdjuster(const OdometryOptions& options) {
  return {MakePrior(test::PinholeCamera().parameters(), options.calibration), options};
}

TEST(MapAdjusterTest, TheMapChangesWhenTheResultIsDueAndNotBefore) {
  test::Random random(1);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random, 8);
  const SE3 before = map.WorldFromKeyframe(4);
  MapAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(map, 10);
  EXPECT_FALSE(adjuster.Finish(13, map));
  EXPECT_EQ(map.WorldFromKeyframe(4), before);
  EXPECT_TRUE(adjuster.Finish(14, map));
  EXPECT_NE(map.WorldFromKeyframe(4), before);
}

TEST(MapAdjusterTest, TheResultIsDueSoonerWhereKeyframesFollowEachOtherFast) {
  test::Random random(1);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random, 1);
  MapAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(map, 10);
  EXPECT_FALSE(adjuster.Finish(11, map));
  EXPECT_TRUE(adjuster.Finish(12, map));
}

TEST(MapAdjusterTest, GivesTheWindowThatAdjustBundleGives) {
  test::Random random(2);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random);
  Map expected = map;
  const OdometryOptions options = FixedCamera();
  Bundle bundle = CopyBundle(expected, SelectWindow(expected, 4, options.bundle_adjuster));
  AdjustBundle(test::PinholeCamera(), options.bundle_adjuster, bundle);
  WriteBack(bundle, expected);
  MapAdjuster adjuster = MakeAdjuster(options);
  adjuster.Start(map, 0);
  adjuster.Finish(kEnd, map);
  for (KeyframeId id = 0; id < 5; ++id) {
    EXPECT_EQ(map.WorldFromKeyframe(id), expected.WorldFromKeyframe(id)) << id;
  }
}

TEST(MapAdjusterTest, AWindowIsAdjustedOnce) {
  test::Random random(3);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random);
  MapAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(map, 0);
  EXPECT_TRUE(adjuster.Finish(kEnd, map));
  adjuster.Start(map, 1);
  EXPECT_FALSE(adjuster.Finish(kEnd, map));
}

TEST(MapAdjusterTest, FindsTheCameraThatTheImagesWereTakenWith) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  MapAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(map, 0);
  EXPECT_EQ(map.camera().parameters().k1, 0);
  adjuster.Finish(kEnd, map);
  EXPECT_FALSE(adjuster.prior_rejected());
  EXPECT_NEAR(map.camera().parameters().k1, 0.04, 0.01);
  EXPECT_LT(adjuster.camera_estimate().covariance(1, 1), 0.01 * 0.01);
}

TEST(MapAdjusterTest, ALastEstimateUsesKeyframesThatToldNone) {
  test::Random random(4), again(4);
  Map map = MakeDisturbedMap(14, test::PinholeCamera(), random);
  Map grown = MakeDisturbedMap(15, test::PinholeCamera(), again);
  MapAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(map, 0);
  adjuster.Finish(kEnd, map);
  const Eigen::MatrixXd before = adjuster.camera_estimate().covariance;
  adjuster.StartLastCalibration(map, 0);
  EXPECT_FALSE(adjuster.Finish(kEnd, map));
  adjuster.StartLastCalibration(grown, 0);
  EXPECT_TRUE(adjuster.Finish(kEnd, grown));
  EXPECT_LT(adjuster.camera_estimate().covariance.trace(), before.trace());
}

TEST(MapAdjusterTest, EstimatesWhatIsNamedAndNothingElse) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  MapAdjuster adjuster({test::PinholeCamera().parameters(), {{"k1", 0.05}}}, OdometryOptions());
  adjuster.Start(map, 0);
  adjuster.Finish(kEnd, map);
  CameraParameters expected = test::PinholeCamera().parameters();
  expected.k1 = map.camera().parameters().k1;
  EXPECT_NEAR(expected.k1, 0.04, 0.005);
  EXPECT_EQ(map.camera().parameters(), expected);
}

TEST(MapAdjusterTest, AFixedCameraStays) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  MapAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(map, 0);
  adjuster.Finish(kEnd, map);
  EXPECT_EQ(adjuster.camera_prior().num_free(), 0);
  EXPECT_EQ(map.camera(), test::PinholeCamera());
}

TEST(MapAdjusterTest, ACameraFarFromTheGivenOneIsAContradiction) {
  test::Random random(5);
  Map map = MakeDistortedMap(0.3, random);
  Map with_fixed_camera = map;
  MapAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(map, 0);
  adjuster.Finish(kEnd, map);
  EXPECT_TRUE(adjuster.prior_rejected());
  EXPECT_EQ(map.camera().parameters().k1, 0);
  MapAdjuster fixed = MakeAdjuster(FixedCamera());
  fixed.Start(with_fixed_camera, 0);
  fixed.Finish(kEnd, with_fixed_camera);
  for (KeyframeId id = 0; id < map.num_keyframes(); ++id) {
    EXPECT_EQ(map.WorldFromKeyframe(id), with_fixed_camera.WorldFromKeyframe(id)) << id;
  }
}

}  // namespace
}  // namespace corvo
