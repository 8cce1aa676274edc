// SPDX-License-Identifier: MIT
#include "vo/tracking/initializer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

class InitializerTest : public ::testing::Test {
 protected:
  InitializationResult Add(const SE3& world_from_camera) {
    test::SceneView view = test::ObserveScene(scene_, camera_, world_from_camera, 0.3, random_);
    return initializer_.AddFrame(std::move(view.frame));
  }

  static SE3 Shifted(double x) { return SE3(SO3(), Eigen::Vector3d(x, 0, 0)); }

  test::Random random_{1};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(500, 3, 12, random_);
  Initializer initializer_{OdometryOptions(), test::MakeModel()};
};

TEST_F(InitializerTest, WaitsForParallaxThenMakesAMapOfUnitMedianDepth) {
  EXPECT_EQ(Add(Shifted(0)).reason, Reason::kReferenceFrame);
  EXPECT_EQ(Add(Shifted(0.001)).reason, Reason::kLowParallax);
  const InitializationResult result = Add(Shifted(0.6));
  ASSERT_TRUE(result.map) << ToString(result.reason);
  EXPECT_EQ(initializer_.reference(), 0);
  EXPECT_GT(result.parallax_deg, 0.5);
  EXPECT_GT(result.num_inliers, 100);

  std::vector<double> depths;
  for (const InitialPoint& point : result.map->points) depths.push_back(point.in_first.z());
  std::sort(depths.begin(), depths.end());
  EXPECT_NEAR(depths[depths.size() / 2], 1, 1e-9);
  const SE3& pose = result.map->first_from_second;
  EXPECT_THAT(pose.rotation(), test::IsRotationNear(SO3(), 0.2));
  EXPECT_GT(pose.translation().normalized().x(), 0.999);

  const std::vector<Frame> frames = initializer_.TakeFrames();
  EXPECT_EQ(frames.size(), 3u);
  EXPECT_TRUE(initializer_.TakeFrames().empty());
}

TEST_F(InitializerTest, TwoViewAdjustmentFollowsTheOptions) {
  const auto initialize = [&](double huber_sigmas) {
    random_ = test::Random(1);
    OdometryOptions options;
    options.bundle_adjuster.huber_sigmas = huber_sigmas;
    initializer_ = Initializer(options, test::MakeModel());
    Add(Shifted(0));
    return Add(Shifted(0.6)).map.value().first_from_second;
  };
  EXPECT_EQ(initialize(1), initialize(1));
  EXPECT_NE(initialize(1), initialize(0.1));
}

TEST_F(InitializerTest, ReportsABlankFrame) {
  EXPECT_EQ(initializer_.AddFrame(Frame()).reason, Reason::kTooFewFeatures);
}

TEST_F(InitializerTest, TakesANewReferenceIfTheOldOneNoLongerMatches) {
  Add(Shifted(0));
  const SE3 turned(SO3::Exp({0, 3.14159, 0}), Eigen::Vector3d::Zero());
  for (Eigen::Vector3d& point : scene_.in_world) point = turned * point;
  for (orb::Descriptor& descriptor : scene_.descriptors)
    descriptor = test::RandomDescriptor(random_);
  EXPECT_EQ(Add(turned).reason, Reason::kTooFewMatches);
  EXPECT_EQ(initializer_.reference(), 1);
  EXPECT_TRUE(Add(turned * Shifted(1.0)).map);
}

TEST_F(InitializerTest, NeverAcceptsAPureRotation) {
  for (int i = 0; i < 20; ++i) {
    const SE3 turned(SO3::Exp({0, 0.02 * i, 0.01 * i}), Eigen::Vector3d::Zero());
    EXPECT_FALSE(Add(turned).map) << i;
  }
}

TEST_F(InitializerTest, PlanarSceneWaitsForASecondConsistentView) {
  scene_ = test::MakePlaneScene(600, 6, random_);
  EXPECT_EQ(Add(Shifted(0)).reason, Reason::kReferenceFrame);
  EXPECT_EQ(Add(Shifted(0.5)).reason, Reason::kPlanar);
  const InitializationResult result = Add(Shifted(0.6));
  ASSERT_TRUE(result.map) << ToString(result.reason);
  const SE3& pose = result.map->first_from_second;
  EXPECT_THAT(pose.rotation(), test::IsRotationNear(SO3(), 0.3));
  EXPECT_GT(pose.translation().normalized().x(), 0.998);
}

TEST_F(InitializerTest, ReportsTheRotationRelativeToItsReference) {
  const auto turned = [](double angle) {
    return SE3(SO3::Exp({0, angle, 0.3 * angle}), Eigen::Vector3d::Zero());
  };
  test::SceneView posed = test::ObserveScene(scene_, camera_, turned(0), 0.3, random_);
  posed.frame.index = 7;
  initializer_.StartFrom(std::move(posed.frame));
  const InitializationResult result = Add(turned(0.15));
  EXPECT_EQ(result.reason, Reason::kRotationOnly);
  EXPECT_EQ(result.reference, 7);
  ASSERT_TRUE(result.reference_from_newest);
  EXPECT_THAT(*result.reference_from_newest, test::IsRotationNear(turned(0.15).rotation(), 0.3));
  EXPECT_FALSE(Add(Shifted(0.6)).reference_from_newest);
}

TEST_F(InitializerTest, ChainsTheRotationThroughAnIntermediateFrame) {
  const auto turned = [](double angle) {
    return SE3(SO3::Exp({0, angle, 0}), Eigen::Vector3d::Zero());
  };
  test::SceneView first = test::ObserveScene(scene_, camera_, turned(-0.55), 0.3, random_);
  test::SceneView between = test::ObserveScene(scene_, camera_, turned(0), 0.3, random_);
  first.frame.index = 7;
  between.frame.index = 8;
  initializer_.AddFrame(std::move(first.frame));
  EXPECT_EQ(initializer_.AddFrame(std::move(between.frame)).reference, 7);
  const InitializationResult result = Add(turned(0.55));
  EXPECT_LT(result.num_matches, 30) << "the first and the last frame have too much in common";
  EXPECT_EQ(result.reason, Reason::kRotationOnly) << ToString(result.reason);
  EXPECT_EQ(result.reference, 8);
  ASSERT_TRUE(result.reference_from_newest);
  EXPECT_THAT(*result.reference_from_newest, test::IsRotationNear(turned(0.55).rotation(), 0.3));
}

TEST_F(InitializerTest, ForgetsTheOldestFrames) {
  OdometryOptions options;
  options.initializer.max_waiting_frames = 3;
  initializer_ = Initializer(options, test::MakeModel());
  for (int i = 0; i < 10; ++i) Add(Shifted(0));
  EXPECT_EQ(initializer_.TakeFrames().size(), 3u);
}

TEST_F(InitializerTest, ForgettingTheOldestFrameKeepsTheReference) {
  OdometryOptions options;
  options.initializer.max_waiting_frames = 4;
  initializer_ = Initializer(options, test::MakeModel());
  for (int i = 0; i < 3; ++i) initializer_.AddFrame(Frame());  // Blank: none can be the reference.
  test::SceneView view = test::ObserveScene(scene_, camera_, Shifted(0), 0.3, random_);
  view.frame.index = 7;
  EXPECT_EQ(initializer_.AddFrame(std::move(view.frame)).reason, Reason::kReferenceFrame);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(Add(Shifted(0)).reference, 7) << i;
    EXPECT_EQ(initializer_.reference(), 2 - i);
  }
}

}  // namespace
}  // namespace corvo
