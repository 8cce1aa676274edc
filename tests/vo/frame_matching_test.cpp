#include "vo/frame_matching.h"

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

TEST(FrameMatchingTest, FindsTheCommonPointsAndNoOthers) {
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

TEST(FrameMatchingTest, RepeatedTextureIsLeftOut) {
  test::Random random(2);
  test::PointScene scene = test::MakeBoxScene(100, 3, 10, random);
  for (int i = 1; i < 100; i += 2) scene.descriptors[i] = scene.descriptors[i - 1];
  const Camera camera = test::PinholeCamera();
  const test::SceneView first = test::ObserveScene(scene, camera, SE3(), 0, random);
  const test::SceneView second = test::ObserveScene(scene, camera, SE3(), 0, random);
  EXPECT_LT(MatchFrames(first.frame, second.frame).size(), first.points.size() / 2);
}

TEST(FrameMatchingTest, EmptyFramesHaveNoMatches) {
  EXPECT_TRUE(MatchFrames(Frame(), Frame()).empty());
}

}  // namespace
}  // namespace corvo
