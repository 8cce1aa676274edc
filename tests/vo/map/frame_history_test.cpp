// SPDX-License-Identifier: MIT
#include "vo/map/frame_history.h"

#include <gmock/gmock.h>

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

class FrameHistoryTest : public ::testing::Test {
 protected:
  FrameHistoryTest() {
    for (int i = 0; i < 8; ++i) {
      Frame frame;
      frame.index = i;
      history_.Add(frame.time_ns);
      history_.outcome(i).state = State::kRotationOnly;
    }
    AddKeyframe(0, 0, pose_);
  }

  KeyframeId AddKeyframe(int frame, int segment, const SE3& world_from_camera) {
    Frame keyframe;
    keyframe.index = frame;
    keyframe.world_from_camera = world_from_camera;
    const KeyframeId id = map_.AddKeyframe(keyframe, segment);
    history_.AddKeyframe(frame, id, map_);
    return id;
  }

  void ExpectPose(int frame, const SE3& world_from_camera) const {
    EXPECT_THAT(history_.PoseOf(frame, map_), test::IsPoseNear(world_from_camera, 1e-9, 1e-9));
  }

  /// Returns the pose of the first keyframe moved forward by `distance`.
  SE3 Ahead(double distance) const { return pose_ * SE3(SO3(), {0, 0, distance}); }

  const SO3 turn_ = SO3::Exp({0.1, -0.2, 0.05});
  const SE3 pose_{SO3::Exp({0, 0.4, 0}), {1, 2, 3}};
  Map map_{test::MakeModel()};
  FrameHistory history_;
};

TEST_F(FrameHistoryTest, ANewFrameHasNeitherPoseNorRotation) {
  const FrameResult result = history_.ResultOf(1, map_);
  EXPECT_FALSE(result.world_from_camera);
  EXPECT_FALSE(result.world_from_camera_rotation);
}

TEST_F(FrameHistoryTest, APoseMovesWithTheOnlyKeyframe) {
  const SE3 keyframe_from_camera = SE3::Exp(SE3::Tangent::Constant(0.1));
  history_.SetPose(1, 0, pose_ * keyframe_from_camera, map_);
  map_.SetPose(0, SE3());
  const FrameResult result = history_.ResultOf(1, map_);
  EXPECT_THAT(*result.world_from_camera, test::IsPoseNear(keyframe_from_camera, 1e-9, 1e-9));
  EXPECT_THAT(*result.world_from_camera_rotation,
              test::IsRotationNear(keyframe_from_camera.rotation(), 1e-9));
}

TEST_F(FrameHistoryTest, APoseBetweenKeyframesMovesWithBoth) {
  history_.SetPose(1, 0, Ahead(1), map_);
  AddKeyframe(4, 0, Ahead(4));
  history_.SetPose(2, 0, Ahead(2), map_);
  ExpectPose(1, Ahead(1));
  map_.SetPose(1, Ahead(4.8));
  ExpectPose(1, Ahead(1.2));
  ExpectPose(2, Ahead(2.4));
  map_.SetPose(0, Ahead(0.8));
  ExpectPose(1, Ahead(1.8));
  ExpectPose(2, Ahead(2.8));
}

TEST_F(FrameHistoryTest, APoseBetweenKeyframesMovesRigidlyWithBoth) {
  const SE3 pose = pose_ * SE3::Exp(SE3::Tangent::Constant(0.2));
  history_.SetPose(1, 0, pose, map_);
  AddKeyframe(2, 0, pose_ * SE3::Exp(SE3::Tangent::Constant(0.3)));
  const SE3 move(turn_, {3, -1, 2});
  map_.SetPose(0, move * map_.WorldFromKeyframe(0));
  map_.SetPose(1, move * map_.WorldFromKeyframe(1));
  ExpectPose(1, move * pose);
}

TEST_F(FrameHistoryTest, APoseAtTheFirstKeyframeMovesWithItAlone) {
  history_.SetPose(1, 0, pose_, map_);
  AddKeyframe(2, 0, Ahead(4));
  map_.SetPose(1, Ahead(5));
  ExpectPose(1, pose_);
}

TEST_F(FrameHistoryTest, APoseBeforeTheFirstKeyframeOfASegmentMovesWithItAlone) {
  AddKeyframe(4, 1, Ahead(4));
  AddKeyframe(6, 1, Ahead(6));
  history_.SetPose(2, 1, Ahead(2), map_);
  map_.SetPose(2, Ahead(7));
  ExpectPose(2, Ahead(2));
  map_.SetPose(1, Ahead(5));
  ExpectPose(2, Ahead(3));
}

TEST_F(FrameHistoryTest, SegmentsDoNotMoveEachOther) {
  history_.SetPose(1, 0, Ahead(1), map_);
  AddKeyframe(2, 1, Ahead(2));
  map_.SetPose(1, Ahead(8));
  ExpectPose(1, Ahead(1));
}

TEST_F(FrameHistoryTest, AfterAKeyframeIsRemovedPosesMoveWithItsNeighbors) {
  history_.SetPose(1, 0, Ahead(1), map_);
  AddKeyframe(2, 0, Ahead(2));
  history_.SetPose(3, 0, Ahead(3), map_);
  AddKeyframe(4, 0, Ahead(4));
  map_.SetPose(1, Ahead(2.2));
  map_.CullKeyframe(1, 0);
  history_.RemoveKeyframe(1, map_);
  ExpectPose(1, Ahead(1.1));
  ExpectPose(2, Ahead(2.2));
  ExpectPose(3, Ahead(3.1));
  map_.SetPose(2, Ahead(8));
  ExpectPose(1, Ahead(2.2));
  ExpectPose(2, Ahead(4.4));
  ExpectPose(3, Ahead(6.2));
}

TEST_F(FrameHistoryTest, AFrameThatReturnsToASegmentMovesWithItsLastKeyframe) {
  AddKeyframe(2, 1, Ahead(9));
  history_.SetPose(4, 0, Ahead(2), map_);
  ExpectPose(4, Ahead(2));
  map_.SetPose(1, Ahead(11));
  ExpectPose(4, Ahead(2));
  map_.SetPose(0, Ahead(1));
  ExpectPose(4, Ahead(3));
}

TEST_F(FrameHistoryTest, FramesMoveWithASegmentThatIsJoinedWithAnEarlierOne) {
  history_.SetPose(1, 0, Ahead(1), map_);
  AddKeyframe(2, 1, Ahead(8));
  AddKeyframe(4, 1, Ahead(12));
  history_.SetPose(3, 1, Ahead(10), map_);
  history_.SetPose(5, 1, Ahead(14), map_);
  for (int i = 0; i < 6; ++i) history_.outcome(i).segment = i < 2 ? 0 : 1;
  map_.SetPose(2, Ahead(13));  // The frames before and after it have moved when they are joined.
  const Sim3 move(0.5, turn_, {3, -1, 2});
  const auto moved = [&](double distance) { return TransformPose(move, Ahead(distance)); };
  history_.JoinSegments({0, 1, move}, map_);
  EXPECT_EQ(map_.SegmentOf(2), 0);
  ExpectPose(1, Ahead(1));
  ExpectPose(2, moved(8));
  ExpectPose(3, moved(10.5));
  ExpectPose(4, moved(13));
  ExpectPose(5, moved(15));
  for (const FrameResult& frame : history_.ToTrajectory(map_).frames) EXPECT_LE(frame.segment, 0);
}

TEST_F(FrameHistoryTest, FramesBetweenJoinedSegmentsMoveWithBoth) {
  history_.SetPose(1, 0, Ahead(1), map_);
  AddKeyframe(2, 1, Ahead(20));
  history_.JoinSegments({0, 1, Sim3(SE3(SO3(), pose_.rotation() * Eigen::Vector3d(0, 0, -16)))},
                        map_);
  ExpectPose(1, Ahead(1));
  map_.SetPose(1, Ahead(4.8));
  ExpectPose(1, Ahead(1.2));
}

TEST_F(FrameHistoryTest, OneOfTwoKeyframesOfAFrameCanBeRemovedAfterTheirSegmentsAreJoined) {
  AddKeyframe(2, 0, Ahead(2));
  AddKeyframe(2, 1, Ahead(2));
  AddKeyframe(4, 1, Ahead(4));
  history_.JoinSegments({0, 1, Sim3()}, map_);
  map_.CullKeyframe(1, 0);
  history_.RemoveKeyframe(1, map_);
  ExpectPose(2, Ahead(2));
}

TEST_F(FrameHistoryTest, ACovarianceIsRelativeToTheFrameOfItsKeyframe) {
  AddKeyframe(2, 0, Ahead(2));
  history_.SetPose(3, 0, Ahead(5), map_);
  EXPECT_FALSE(history_.ResultOf(3, map_).relative_pose);
  const SE3::Matrix6 covariance = 0.0625 * SE3::Matrix6::Identity();
  history_.SetCovariance(3, 1, covariance);
  const RelativePose relative = *history_.ResultOf(3, map_).relative_pose;
  EXPECT_EQ(relative.reference, 2);
  EXPECT_THAT(relative.covariance, test::IsMatrixNear(covariance, 1e-7));
  EXPECT_THAT(relative.reference_from_camera, test::IsPoseNear(SE3(SO3(), {0, 0, 3}), 1e-9, 1e-9));
  map_.SetPose(1, Ahead(4));
  EXPECT_THAT(history_.ResultOf(3, map_).relative_pose->reference_from_camera,
              test::IsPoseNear(SE3(SO3(), {0, 0, 3}), 1e-9, 1e-9));
}

TEST_F(FrameHistoryTest, ACovarianceThatIsNotFiniteIsNotStated) {
  history_.SetCovariance(0, 0, SE3::Matrix6::Constant(std::nan("")));
  EXPECT_FALSE(history_.ResultOf(0, map_).relative_pose);
}

TEST_F(FrameHistoryTest, ACovarianceStaysPositiveDefinite) {
  // Translation to the side and rotation are nearly the same to a camera with a narrow view.
  AddKeyframe(2, 0, Ahead(2));
  SE3::Matrix6 factor = SE3::Matrix6::Identity();
  factor(4, 0) = 1e4;
  const SE3::Matrix6 covariance = factor * factor.transpose();
  history_.SetCovariance(2, 0, covariance);
  const SE3::Matrix6 stated = history_.ResultOf(2, map_).relative_pose->covariance;
  EXPECT_THAT(stated, test::IsMatrixNear(covariance, 1));
  EXPECT_EQ(Eigen::LLT<SE3::Matrix6>(stated).info(), Eigen::Success);
  EXPECT_NEAR(stated.determinant(), 1, 0.01);
}

TEST_F(FrameHistoryTest, ACovarianceIsInUnitsOfItsSegment) {
  AddKeyframe(2, 1, SE3());
  AddKeyframe(4, 1, Ahead(1));
  history_.SetPose(5, 1, Ahead(2), map_);
  for (const int frame : {2, 4, 5}) history_.outcome(frame).segment = 1;
  history_.SetCovariance(5, 2, SE3::Matrix6::Identity());
  history_.JoinSegments({0, 1, Sim3(0.5, SO3(), {0, 0, 0})}, map_);
  Eigen::Matrix<double, 6, 1> variances;
  variances << 0.25, 0.25, 0.25, 1, 1, 1;
  EXPECT_THAT(history_.ResultOf(5, map_).relative_pose->covariance,
              test::IsMatrixNear(SE3::Matrix6(variances.asDiagonal()), 1e-6));
}

TEST_F(FrameHistoryTest, RotationsAreChainedToAPosedFrame) {
  history_.SetRotation(1, 0, turn_);
  history_.SetRotation(2, 1, turn_);
  const FrameResult result = history_.ResultOf(2, map_);
  EXPECT_FALSE(result.world_from_camera);
  EXPECT_THAT(*result.world_from_camera_rotation,
              test::IsRotationNear(pose_.rotation() * turn_ * turn_, 1e-9));
}

TEST_F(FrameHistoryTest, RotationsAreChainedToTheBeginning) {
  history_.SetRotation(1, 1, SO3());
  history_.SetRotation(2, 1, turn_);
  EXPECT_THAT(*history_.RotationOf(2, map_), test::IsRotationNear(turn_, 1e-9));
}

TEST_F(FrameHistoryTest, APoseReplacesARotation) {
  history_.SetRotation(1, 1, turn_);
  history_.SetPose(1, 0, Ahead(1), map_);
  EXPECT_THAT(*history_.ResultOf(1, map_).world_from_camera,
              test::IsPoseNear(Ahead(1), 1e-9, 1e-9));
  EXPECT_THAT(*history_.RotationOf(1, map_), test::IsRotationNear(pose_.rotation(), 1e-9));
}

TEST_F(FrameHistoryTest, AFrameIsAKeyframeOfTheSegmentThatPosesItFirst) {
  AddKeyframe(4, 0, Ahead(4));
  history_.SetPose(2, 0, Ahead(2), map_);
  AddKeyframe(2, 1, Ahead(8));
  EXPECT_TRUE(history_.outcome(4).is_keyframe);
  EXPECT_FALSE(history_.outcome(2).is_keyframe);
  ExpectPose(2, Ahead(2));
}

TEST_F(FrameHistoryTest, AFrameTakesAtMost300Bytes) {
  EXPECT_LE(history_.num_bytes(), 300u * static_cast<std::size_t>(history_.size()));
}

TEST_F(FrameHistoryTest, ABrokenChainOfRotationsGivesNoRotation) {
  history_.SetRotation(3, 2, turn_);
  EXPECT_FALSE(history_.RotationOf(3, map_));
}

TEST_F(FrameHistoryTest, StatusOfAFailedAdjustmentIsKept) {
  history_.AddAdjustments({AdjustmentStatus::kConverged, AdjustmentStatus::kNone});
  EXPECT_EQ(history_.outcome(7).window_adjustment, AdjustmentStatus::kConverged);
  EXPECT_EQ(history_.outcome(7).camera_adjustment, AdjustmentStatus::kNone);
  history_.AddAdjustments({AdjustmentStatus::kSolverFailed, AdjustmentStatus::kConverged});
  history_.AddAdjustments({AdjustmentStatus::kIterationLimit, AdjustmentStatus::kNone});
  EXPECT_EQ(history_.outcome(7).window_adjustment, AdjustmentStatus::kSolverFailed);
  EXPECT_EQ(history_.outcome(7).camera_adjustment, AdjustmentStatus::kConverged);
}

}  // namespace
}  // namespace corvo
