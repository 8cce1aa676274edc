// SPDX-License-Identifier: MIT
#include "vo/mapping/background_adjuster.h"

#include <gmock/gmock.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {
namespace {

constexpr int kEnd = std::numeric_limits<int>::max();

/// Makes a map of views along a turning path, taken with the camera `taken_with`, `spacing` frames
/// apart; the poses of all keyframes but the first are disturbed.
Map MakeDisturbedMap(int num_views, const Camera& taken_with, test::Random& random, int spacing = 5,
                     double disturbance = 0.01) {
  const test::PointScene scene = test::MakeBoxScene(600, 3, 12, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < num_views; ++i) {
    const SE3 pose(SO3::Exp({0, 0.03 * i, 0}), Eigen::Vector3d(0.25 * i, 0.05 * (i % 3), 0));
    views.push_back(test::ObserveScene(scene, taken_with, pose, 0.3, random));
    views.back().frame.index = spacing * i;
  }
  Map map = test::MakeMap(scene, views);
  for (KeyframeId id = 1; id < num_views; ++id) {
    map.SetPose(id, map.WorldFromKeyframe(id) * SE3::Exp(random.Vector<6>(disturbance)));
  }
  return map;
}

/// Like MakeDisturbedMap() with 14 views, but the true camera has this k1, while PinholeCamera()
/// has none.
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

BackgroundAdjuster MakeAdjuster(const OdometryOptions& options) {
  return {MakePrior(test::PinholeCamera().parameters(), options.calibration), options};
}

TEST(BackgroundAdjusterTest, TheMapChangesOnlyOnceTheResultIsDue) {
  test::Random random(1);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random, 8);
  const SE3 before = map.WorldFromKeyframe(4);
  BackgroundAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(10, map);
  EXPECT_FALSE(adjuster.UseResults(13, map).any());
  EXPECT_EQ(map.WorldFromKeyframe(4), before);
  EXPECT_TRUE(adjuster.UseResults(14, map).any());
  EXPECT_NE(map.WorldFromKeyframe(4), before);
}

TEST(BackgroundAdjusterTest, TheResultIsDueSoonerIfKeyframesAreFrequent) {
  test::Random random(1);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random, 1);
  BackgroundAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(10, map);
  EXPECT_FALSE(adjuster.UseResults(11, map).any());
  EXPECT_TRUE(adjuster.UseResults(12, map).any());
}

TEST(BackgroundAdjusterTest, ResultEqualsThatOfTheBundleAdjuster) {
  test::Random random(2);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random);
  Map expected = map;
  const OdometryOptions options = FixedCamera();
  Bundle bundle = CopyBundle(expected, SelectWindow(expected, 4, options.bundle_adjuster));
  BundleAdjuster(WindowAdjustment(options.bundle_adjuster)).Adjust(test::PinholeCamera(), bundle);
  WriteBack(bundle, expected);
  BackgroundAdjuster adjuster = MakeAdjuster(options);
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  for (KeyframeId id = 0; id < 5; ++id) {
    EXPECT_EQ(map.WorldFromKeyframe(id), expected.WorldFromKeyframe(id)) << id;
  }
}

TEST(BackgroundAdjusterTest, AWindowIsAdjustedOnce) {
  test::Random random(3);
  Map map = MakeDisturbedMap(5, test::PinholeCamera(), random);
  BackgroundAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(0, map);
  EXPECT_TRUE(adjuster.UseResults(kEnd, map).any());
  adjuster.Start(1, map);
  EXPECT_FALSE(adjuster.UseResults(kEnd, map).any());
}

TEST(BackgroundAdjusterTest, EstimatesTheTrueCamera) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  BackgroundAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(0, map);
  EXPECT_EQ(map.camera().parameters().k1, 0);
  adjuster.UseResults(kEnd, map);
  EXPECT_FALSE(adjuster.prior_rejected());
  EXPECT_NEAR(map.camera().parameters().k1, 0.04, 0.01);
  EXPECT_LT(adjuster.camera_estimate().covariance(1, 1), 0.01 * 0.01);
}

TEST(BackgroundAdjusterTest, KeyframesOfEarlierBlocksFollowTheCamera) {
  test::Random random(9), again(9);
  OdometryOptions options;
  options.calibration.block_keyframes = 5;
  options.calibration.max_displacement_px = 0;
  BackgroundAdjuster adjuster = MakeAdjuster(options);
  Map map = MakeDisturbedMap(14, test::PinholeCamera(), random);
  adjuster.StartLastCalibration(0, map);
  adjuster.UseResults(kEnd, map);
  Map grown = MakeDisturbedMap(20, test::PinholeCamera(), again);
  std::vector<SE3> before;
  for (KeyframeId id = 0; id < 14; ++id) before.push_back(grown.WorldFromKeyframe(id));
  adjuster.StartLastCalibration(0, grown);
  adjuster.UseResults(kEnd, grown);
  for (KeyframeId id = 1; id < 14; ++id) EXPECT_NE(grown.WorldFromKeyframe(id), before[id]) << id;
}

TEST(BackgroundAdjusterTest, NothingFollowsACameraThatHardlyChanges) {
  test::Random random(9);
  Map map = MakeDistortedMap(0, random);
  OdometryOptions options;
  options.calibration.max_displacement_px = 50;
  BackgroundAdjuster adjuster = MakeAdjuster(options);
  const SE3 before = map.WorldFromKeyframe(13);
  adjuster.StartLastCalibration(0, map);
  EXPECT_EQ(adjuster.UseResults(kEnd, map).camera, AdjustmentStatus::kConverged);
  EXPECT_EQ(map.WorldFromKeyframe(13), before);
  EXPECT_NE(map.camera(), test::PinholeCamera());
}

TEST(BackgroundAdjusterTest, TheLastCalibrationUsesKeyframesThatNoEstimateHasUsed) {
  test::Random random(4), again(4);
  Map map = MakeDisturbedMap(14, test::PinholeCamera(), random, 5, 0.002);
  Map grown = MakeDisturbedMap(15, test::PinholeCamera(), again, 5, 0.002);
  BackgroundAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  const Eigen::MatrixXd before = adjuster.camera_estimate().covariance;
  adjuster.StartLastCalibration(0, map);
  EXPECT_FALSE(adjuster.UseResults(kEnd, map).any());
  adjuster.StartLastCalibration(0, grown);
  EXPECT_TRUE(adjuster.UseResults(kEnd, grown).any());
  EXPECT_LT(adjuster.camera_estimate().covariance.trace(), before.trace());
}

TEST(BackgroundAdjusterTest, EstimatesOnlyTheFreeParameters) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  BackgroundAdjuster adjuster({test::PinholeCamera().parameters(), {{"k1", 0.05}}},
                              OdometryOptions());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  CameraParameters expected = test::PinholeCamera().parameters();
  expected.k1 = map.camera().parameters().k1;
  EXPECT_NEAR(expected.k1, 0.04, 0.005);
  EXPECT_EQ(map.camera().parameters(), expected);
}

TEST(BackgroundAdjusterTest, AFixedCameraIsNotChanged) {
  test::Random random(4);
  Map map = MakeDistortedMap(0.04, random);
  BackgroundAdjuster adjuster = MakeAdjuster(FixedCamera());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  EXPECT_EQ(adjuster.camera_prior().num_free(), 0);
  EXPECT_EQ(map.camera(), test::PinholeCamera());
}

TEST(BackgroundAdjusterTest, ACameraFarFromThePriorRejectsThePrior) {
  test::Random random(5);
  Map map = MakeDistortedMap(0.3, random);
  Map with_fixed_camera = map;
  BackgroundAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  EXPECT_TRUE(adjuster.prior_rejected());
  EXPECT_EQ(map.camera().parameters().k1, 0);
  BackgroundAdjuster fixed = MakeAdjuster(FixedCamera());
  fixed.Start(0, with_fixed_camera);
  fixed.UseResults(kEnd, with_fixed_camera);
  for (KeyframeId id = 0; id < map.num_keyframes(); ++id) {
    EXPECT_EQ(map.WorldFromKeyframe(id), with_fixed_camera.WorldFromKeyframe(id)) << id;
  }
}

/// Adds `num_views` views of another scene to a map, as a segment of its own.
void AddSegment(int num_views, const Camera& taken_with, test::Random& random, Map& map) {
  const Map other = MakeDisturbedMap(num_views, taken_with, random);
  const KeyframeId first = map.num_keyframes();
  for (KeyframeId id = 0; id < num_views; ++id) {
    Frame frame = other.keyframe(id).frame;
    frame.landmarks.assign(frame.landmarks.size(), kNoId);
    frame.index += 5 * first;
    map.AddKeyframe(std::move(frame), 1);
  }
  for (LandmarkId id = 0; id < other.num_landmark_ids(); ++id) {
    const Landmark& landmark = *other.FindLandmark(id);
    std::vector<TrackElement> track = landmark.track;
    for (TrackElement& element : track) element.keyframe += first;
    map.UpdateAppearance(map.AddLandmark(landmark.in_world, track));
  }
}

TEST(BackgroundAdjusterTest, ANewSegmentAddsToWhatTheOneBeforeTellsOfTheCamera) {
  test::Random random(7);
  CameraParameters true_camera = test::PinholeCamera().parameters();
  true_camera.k1 = 0.04;
  Map map = MakeDisturbedMap(14, Camera(true_camera), random);
  BackgroundAdjuster adjuster = MakeAdjuster(OdometryOptions());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  const Eigen::VectorXd before = adjuster.camera_estimate().covariance.diagonal();
  AddSegment(5, Camera(true_camera), random, map);
  adjuster.StartLastCalibration(0, map);
  EXPECT_TRUE(adjuster.UseResults(kEnd, map).any());
  const CameraEstimate& after = adjuster.camera_estimate();
  EXPECT_TRUE((after.covariance.diagonal().array() < before.array()).all());
  EXPECT_NEAR(after.difference[1], 0.04, 0.01);
  EXPECT_TRUE(after.is_consistent);
}

TEST(BackgroundAdjusterTest, ALensThatChangesIsNoticed) {
  test::Random random(8);
  CameraParameters lens = test::PinholeCamera().parameters();
  Map map = MakeDisturbedMap(14, Camera(lens), random);
  BackgroundAdjuster adjuster({lens, {{"focal", 0.1}, {"k1", 0.5}}}, OdometryOptions());
  adjuster.Start(0, map);
  adjuster.UseResults(kEnd, map);
  EXPECT_TRUE(adjuster.camera_estimate().is_consistent);
  const double k1_variance = adjuster.camera_estimate().covariance(1, 1);
  lens.k1 = 0.15;
  AddSegment(14, Camera(lens), random, map);
  adjuster.StartLastCalibration(0, map);
  adjuster.UseResults(kEnd, map);
  EXPECT_FALSE(adjuster.camera_estimate().is_consistent);
  EXPECT_GT(adjuster.camera_estimate().covariance(1, 1), k1_variance);
}

TEST(BackgroundAdjusterTest, FailureIsReportedAndTheMapIsUnchanged) {
  test::Random random(6);
  Map map = MakeDisturbedMap(14, test::PinholeCamera(), random);
  const Eigen::Vector2d nan = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  map.SetPixel({13, 0}, nan, nan);
  std::vector<SE3> before;
  for (KeyframeId id = 0; id < 14; ++id) before.push_back(map.WorldFromKeyframe(id));
  OdometryOptions options;
  options.calibration.max_displacement_px = 0;
  BackgroundAdjuster adjuster = MakeAdjuster(options);
  adjuster.Start(0, map);
  const UsedAdjustments used = adjuster.UseResults(kEnd, map);
  EXPECT_EQ(used.window, AdjustmentStatus::kSolverFailed);
  EXPECT_EQ(used.camera, AdjustmentStatus::kSolverFailed);
  for (KeyframeId id = 0; id < 14; ++id) EXPECT_EQ(map.WorldFromKeyframe(id), before[id]) << id;
  EXPECT_EQ(map.camera(), test::PinholeCamera());
}

}  // namespace
}  // namespace corvo
