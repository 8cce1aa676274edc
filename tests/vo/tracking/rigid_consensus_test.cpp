// SPDX-License-Identifier: MIT
#include "vo/tracking/rigid_consensus.h"

#include <gtest/gtest.h>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// A frame of a static scene in which a rigid object moves. Both are in the map.
class RigidConsensusTest : public ::testing::Test {
 protected:
  RigidConsensusTest() {
    for (int i = 0; i < 3; ++i) views_.push_back(View(Shifted(0.3 * i)));
    map_ = test::MakeMap(scene_, views_);
  }

  static SE3 Shifted(double x) { return SE3(SO3(), {x, 0, 0}); }

  test::SceneView View(const SE3& pose) {
    return test::ObserveScene(scene_, test::PinholeCamera(), pose, 0.3, random_);
  }

  bool IsOnObject(LandmarkId id) const {
    return map_.FindLandmark(id)->in_world.x() < max_object_x_;
  }

  /// Returns a frame that observes the scene from `scene_pose` and the object, which comprises the
  /// points to the left of `max_object_x_`, as if from `object_pose`. Its pose is between them.
  Frame Observe(const SE3& scene_pose, const SE3& object_pose) {
    Frame frame = map_.keyframe(2).frame;
    frame.patches.clear();
    for (int k = 0; k < frame.num_keypoints(); ++k) {
      if (frame.landmarks[k] == kNoId) continue;
      const SE3& pose = IsOnObject(frame.landmarks[k]) ? object_pose : scene_pose;
      const Eigen::Vector3d& in_world = map_.FindLandmark(frame.landmarks[k])->in_world;
      const auto pixel = map_.camera().Project(pose.Inverse() * in_world);
      if (pixel) frame.pixels[k] = *pixel;
    }
    frame.world_from_camera = Shifted(0.75);
    return frame;
  }

  /// Lets the landmarks of the scene be found in more frames than those of the object.
  void Age(int num_frames) {
    Frame frame = map_.keyframe(2).frame;
    for (LandmarkId& id : frame.landmarks) {
      if (id != kNoId && IsOnObject(id)) id = kNoId;
    }
    for (int i = 0; i < num_frames; ++i) map_.CountSeen(frame.landmarks, frame);
  }

  test::Random random_{1};
  double max_object_x_ = 0.8;
  test::PointScene scene_ = test::MakeBoxScene(400, 5, 6, random_);
  std::vector<test::SceneView> views_;
  Map map_{test::MakeModel()};
  const SE3 scene_pose_ = Shifted(0.9);
  const SE3 object_pose_ = Shifted(0.6);
};

TEST_F(RigidConsensusTest, TheMotionOfTheMajorityWinsWithoutAPast) {
  const Frame frame = Observe(scene_pose_, object_pose_);
  const LandmarkPose pose = FindRigidConsensus(map_, frame, PoseOptimizerOptions());
  EXPECT_THAT(pose.world_from_camera, test::IsPoseNear(object_pose_, 0.5, 0.05));
}

TEST_F(RigidConsensusTest, TheMotionThatAgreesWithThePastWinsAgainstTheMajority) {
  Age(8);
  const Frame frame = Observe(scene_pose_, object_pose_);
  const LandmarkPose pose = FindRigidConsensus(map_, frame, PoseOptimizerOptions());
  EXPECT_THAT(pose.world_from_camera, test::IsPoseNear(scene_pose_, 0.1, 0.02));
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    EXPECT_FALSE(pose.landmarks[k] != kNoId && IsOnObject(pose.landmarks[k])) << k;
  }
  for (const int k : FindContradictions(frame, pose)) EXPECT_TRUE(IsOnObject(frame.landmarks[k]));
  EXPECT_GT(FindContradictions(frame, pose).size(), 50u);
}

TEST_F(RigidConsensusTest, WithoutAConflictEveryLandmarkCounts) {
  Age(8);
  const Frame frame = Observe(scene_pose_, scene_pose_);
  const LandmarkPose pose = FindRigidConsensus(map_, frame, PoseOptimizerOptions());
  EXPECT_THAT(pose.world_from_camera, test::IsPoseNear(scene_pose_, 0.1, 0.02));
  EXPECT_EQ(pose.num_inliers, CountObservedLandmarks(frame));
  EXPECT_TRUE(FindContradictions(frame, pose).empty());
}

}  // namespace
}  // namespace corvo
