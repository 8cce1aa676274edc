// SPDX-License-Identifier: MIT
#include "vo/tracking/scale_monitor.h"

#include <gtest/gtest.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kFrameSeconds = 0.1;  // s
constexpr double kSceneDepth = 10;

/// Feeds frames to a monitor, whose images flow by `flow` units of length at kSceneDepth per
/// second.
class ScaleMonitorTest : public ::testing::Test {
 protected:
  /// Returns the number of uncertain frames among `num_frames` that move alike.
  int Add(int num_frames, double speed, double flow, double inlier_share = 0.9) {
    int num_uncertain = 0;
    for (int i = 0; i < num_frames; ++i) {
      num_uncertain +=
          monitor_.Add({inlier_share, 0, kFrameSeconds, unit_ * speed, unit_ * kSceneDepth},
                       [&] { return std::optional(flow / kSceneDepth * kFrameSeconds); });
    }
    return num_uncertain;
  }

  ScaleMonitor monitor_;
  double unit_ = 1;  ///< Of lengths in the map.
};

TEST_F(ScaleMonitorTest, SteadyMotionIsCertain) { EXPECT_EQ(Add(100, 5, 5), 0); }

TEST_F(ScaleMonitorTest, ACameraThatStopsAndGoesOnIsCertain) {
  EXPECT_EQ(Add(20, 5, 5) + Add(20, 0, 0) + Add(20, 5, 5), 0);
}

TEST_F(ScaleMonitorTest, ASpeedThatCollapsesWhileTheImagesFlowIsUncertain) {
  EXPECT_EQ(Add(20, 5, 5), 0);
  EXPECT_GE(Add(5, 0.5, 5), 3);
}

TEST_F(ScaleMonitorTest, ASpeedThatGrowsWhileTheImagesFlowAsBeforeIsUncertain) {
  EXPECT_EQ(Add(20, 5, 5), 0);
  EXPECT_GE(Add(5, 50, 5), 3);
}

TEST_F(ScaleMonitorTest, TheUnitOfLengthDoesNotMatter) {
  for (const double unit : {1e-4, 0.05, 1e4}) {
    unit_ = unit;
    monitor_ = ScaleMonitor();
    EXPECT_EQ(Add(20, 5, 5), 0) << unit;
    EXPECT_GE(Add(5, 0.5, 5), 3) << unit;
  }
}

TEST_F(ScaleMonitorTest, OneOutlierAmongTheSpeedsIsCertain) {
  EXPECT_EQ(Add(20, 5, 5) + Add(1, 0.1, 5) + Add(20, 5, 5), 0);
}

TEST_F(ScaleMonitorTest, AChangeOfSpeedIsUncertainIfTheFlowIsUnknown) {
  Add(20, 5, 5);
  Add(2, 0.5, 0.5);
  EXPECT_TRUE(monitor_.Add({0.9, 0, kFrameSeconds, 0.5, kSceneDepth}, [] { return std::nullopt; }));
}

TEST_F(ScaleMonitorTest, FramesWhoseMatchesContradictEachOtherAreUncertain) {
  EXPECT_EQ(Add(20, 5, 5, 0.6), 0);
  EXPECT_EQ(Add(2, 5, 5, 0.5), 0);  // Two frames are too few.
  EXPECT_EQ(Add(5, 5, 5, 0.5), 5);
}

TEST_F(ScaleMonitorTest, FiveSuchFramesAreEnough) {
  EXPECT_EQ(Add(4, 5, 5, 0.5), 0);
  EXPECT_EQ(Add(1, 5, 5, 0.5), 1);
}

TEST_F(ScaleMonitorTest, AFrameThatIsContestedInLargePartIsUncertain) {
  const auto flow = [] { return std::optional(0.05); };
  EXPECT_FALSE(monitor_.Add({0.9, 0.2, kFrameSeconds, 5, kSceneDepth}, flow));
  EXPECT_TRUE(monitor_.Add({0.9, 0.4, kFrameSeconds, 5, kSceneDepth}, flow));
}

class ParallaxFlowTest : public ::testing::Test {
 protected:
  Frame View(const SE3& pose) {
    return test::ObserveScene(scene_, test::PinholeCamera(), pose, 0.2, random_).frame;
  }

  test::Random random_{3};
  test::PointScene scene_ = test::MakeBoxScene(400, 9.9, 10.1, random_);
};

TEST_F(ParallaxFlowTest, IsTheAngleOfTheTranslationAtTheDepthOfTheScene) {
  const Frame previous = View(SE3());
  const Frame frame = View(SE3(SO3(), {0.5, 0, 0}));
  EXPECT_NEAR(*MeasureParallaxFlow(previous, frame), 0.05, 0.005);
}

TEST_F(ParallaxFlowTest, DoesNotContainTheRotation) {
  const Frame previous = View(SE3());
  const Frame frame = View(SE3(SO3::Exp({0.02, 0.1, 0}), Eigen::Vector3d::Zero()));
  EXPECT_LT(*MeasureParallaxFlow(previous, frame), 0.002);
}

/// Most keypoints are on an object that moves with the camera, on a quarter of the image.
TEST_F(ParallaxFlowTest, IsThatOfTheSceneIfMostMatchesAreOnAnObjectThatMovesWithTheCamera) {
  Frame previous = View(SE3());
  Frame frame = View(SE3(SO3(), {0.5, 0, 0}));
  orb::Features object;
  for (int i = 0; i < 2000; ++i) {
    orb::Keypoint keypoint;
    keypoint.x = static_cast<float>(random_.Uniform(160, 480));
    keypoint.y = static_cast<float>(random_.Uniform(120, 360));
    object.keypoints.push_back(keypoint);
    object.descriptors.push_back(test::RandomDescriptor(random_));
  }
  const auto add_object = [&](const Frame& view) {
    orb::Features features = view.features;
    for (int i = 0; i < 2000; ++i) {
      features.keypoints.push_back(object.keypoints[i]);
      features.descriptors.push_back(object.descriptors[i]);
    }
    Frame both = MakeFrame(0, 0, features, test::PinholeCamera());
    both.world_from_camera = view.world_from_camera;
    return both;
  };
  EXPECT_NEAR(*MeasureParallaxFlow(add_object(previous), add_object(frame)), 0.05, 0.01);
}

TEST_F(ParallaxFlowTest, IsUnknownWithoutMatches) {
  const Frame previous = View(SE3());
  scene_ = test::MakeBoxScene(400, 9.9, 10.1, random_);
  EXPECT_EQ(MeasureParallaxFlow(previous, View(SE3())), std::nullopt);
}

TEST(ScaleEvidenceTest, IsMeasuredFromTheFrames) {
  test::Random random(4);
  const test::PointScene scene = test::MakeBoxScene(300, 4.9, 5.1, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < 2; ++i) {
    const SE3 pose(SO3(), {0.3 * i, 0, 0});
    views.push_back(test::ObserveScene(scene, test::PinholeCamera(), pose, 0.2, random));
  }
  const Map map = test::MakeMap(scene, views);
  Frame previous = map.keyframe(0).frame;
  previous.time_ns = 3'000'000'000;
  Frame frame = map.keyframe(1).frame;
  frame.time_ns = previous.time_ns + 200'000'000;
  TrackingResult tracking;
  tracking.num_matches = 100;
  tracking.num_inliers = 70;
  tracking.contested_share = 0.1;
  const ScaleEvidence evidence = CollectScaleEvidence(map, previous, frame, tracking);
  EXPECT_EQ(evidence.inlier_share, 0.7);
  EXPECT_EQ(evidence.contested_share, 0.1);
  EXPECT_DOUBLE_EQ(evidence.duration_s, 0.2);
  EXPECT_NEAR(evidence.speed, 1.5, 1e-9);
  EXPECT_NEAR(evidence.depth, 5, 0.1);
}

}  // namespace
}  // namespace corvo
