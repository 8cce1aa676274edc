// SPDX-License-Identifier: MIT
#include "vo/tracking/frame_matching.h"

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

TEST(FrameMatchingTest, FindsOnlyTheCommonPoints) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 10, random);
  const Camera camera = test::PinholeCamera();
  const SE3 moved(SO3::Exp({0, 0.1, 0}), Eigen::Vector3d(0.5, 0, 0));
  const test::SceneView first = test::ObserveScene(scene, camera, SE3(), 0.5, random);
  const test::SceneView second = test::ObserveScene(scene, camera, moved, 0.5, random);
  const auto matches = MatchFrames(first.frame, second.frame);
  EXPECT_GT(matches.size(), 150u);
  for (const orb::Match& match : matches) {
    EXPECT_EQ(first.points[match.query], second.points[match.train]);
  }
}

TEST(FrameMatchingTest, AmbiguousMatchesAreRejected) {
  test::Random random(2);
  const test::PointScene scene = test::MakeBoxScene(200, 3, 10, random);
  const Camera camera = test::PinholeCamera();
  test::SceneView first = test::ObserveScene(scene, camera, SE3(), 0, random);
  test::SceneView second = test::ObserveScene(scene, camera, SE3(), 0, random);
  second.frame.features.descriptors[1] = second.frame.features.descriptors[0];
  const int twin = second.points[0], other_twin = second.points[1];
  const auto matches = MatchFrames(first.frame, second.frame);
  EXPECT_EQ(matches.size(), first.points.size() - 2);
  for (const orb::Match& match : matches) {
    EXPECT_NE(first.points[match.query], twin);
    EXPECT_NE(first.points[match.query], other_twin);
  }
}

TEST(FrameMatchingTest, MatchRotatedFramesFindsOnlyPointsNearTheirPrediction) {
  test::Random random(3);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 10, random);
  const Camera camera = test::PinholeCamera();
  const SE3 moved(SO3::Exp({0, 0.2, 0.1}), Eigen::Vector3d(0.05, 0, 0));
  const test::SceneView first = test::ObserveScene(scene, camera, SE3(), 0.3, random);
  const test::SceneView second = test::ObserveScene(scene, camera, moved, 0.3, random);
  const auto match = [&](const SO3& second_from_first) {
    return MatchRotatedFrames({first.frame, second.frame, second_from_first}, test::MakeModel(),
                              12);
  };
  const SO3 truth = moved.rotation().Inverse();
  const auto matches = match(truth);
  EXPECT_GT(matches.size(), 100u);
  for (const orb::Match& m : matches) {
    EXPECT_EQ(first.points[m.query], second.points[m.train]);
    const auto pixel = camera.Project(truth * first.frame.rays[m.query].homogeneous());
    EXPECT_LE((*pixel - second.frame.pixel(m.train)).norm(), 12);
  }
  EXPECT_LT(match(truth * SO3::Exp({0, 0.1, 0})).size(), 5u);
}

TEST(FrameMatchingTest, EmptyFramesHaveNoMatches) {
  EXPECT_TRUE(MatchFrames(Frame(), Frame()).empty());
}

}  // namespace
}  // namespace corvo
