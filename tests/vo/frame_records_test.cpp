#include "vo/frame_records.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

class FrameRecordsTest : public ::testing::Test {
 protected:
  FrameRecordsTest() {
    for (int i = 0; i < 4; ++i) {
      FrameOutcome outcome;
      outcome.index = i;
      outcome.state = State::kRotationOnly;
      records_.Add(outcome);
    }
    Frame keyframe;
    keyframe.world_from_camera = pose_;
    keyframe_ = map_.AddKeyframe(keyframe, 0);
  }

  const SO3 turn_ = SO3::Exp({0.1, -0.2, 0.05});
  const SE3 pose_{SO3::Exp({0, 0.4, 0}), {1, 2, 3}};
  Map map_;
  KeyframeId keyframe_ = kNoId;
  FrameRecords records_;
};

TEST_F(FrameRecordsTest, NothingIsKnownOfANewFrame) {
  const FrameResult result = records_.ResultOf(0, map_);
  EXPECT_FALSE(result.world_from_camera);
  EXPECT_FALSE(result.world_from_camera_rotation);
}

TEST_F(FrameRecordsTest, APoseMovesWithItsKeyframe) {
  const SE3 keyframe_from_camera = SE3::Exp(SE3::Tangent::Constant(0.1));
  records_.SetPose(1, keyframe_, keyframe_from_camera);
  map_.SetPose(keyframe_, SE3());
  const FrameResult result = records_.ResultOf(1, map_);
  EXPECT_THAT(*result.world_from_camera, test::IsPoseNear(keyframe_from_camera, 1e-9, 1e-9));
  EXPECT_THAT(*result.world_from_camera_rotation,
              test::IsRotationNear(keyframe_from_camera.rotation(), 1e-9));
}

TEST_F(FrameRecordsTest, RotationsAreChainedToAPosedFrame) {
  records_.SetPose(0, keyframe_, SE3());
  records_.SetRotation(1, 0, turn_);
  records_.SetRotation(2, 1, turn_);
  const FrameResult result = records_.ResultOf(2, map_);
  EXPECT_FALSE(result.world_from_camera);
  EXPECT_THAT(*result.world_from_camera_rotation,
              test::IsRotationNear(pose_.rotation() * turn_ * turn_, 1e-9));
}

TEST_F(FrameRecordsTest, RotationsAreChainedToTheBeginning) {
  records_.SetRotation(0, 0, SO3());
  records_.SetRotation(2, 0, turn_);
  EXPECT_THAT(*records_.RotationOf(2, map_), test::IsRotationNear(turn_, 1e-9));
}

TEST_F(FrameRecordsTest, APoseTakesThePlaceOfARotation) {
  records_.SetRotation(0, 0, turn_);
  records_.SetPose(0, keyframe_, SE3());
  EXPECT_EQ(*records_.ResultOf(0, map_).world_from_camera, pose_);
  EXPECT_THAT(*records_.RotationOf(0, map_), test::IsRotationNear(pose_.rotation(), 1e-9));
}

TEST_F(FrameRecordsTest, AFrameTakesAtMost200Bytes) {
  EXPECT_LE(records_.num_bytes(), 200u * static_cast<std::size_t>(records_.size()));
}

TEST_F(FrameRecordsTest, ABrokenChainTellsNothing) {
  records_.SetRotation(2, 1, turn_);
  EXPECT_FALSE(records_.RotationOf(2, map_));
}

}  // namespace
}  // namespace corvo
