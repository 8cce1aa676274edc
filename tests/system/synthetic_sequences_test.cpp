// SPDX-License-Identifier: MIT
// Runs the complete odometry on rendered sequences with exact ground truth.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/system/sequence_runner.h"

namespace corvo {
namespace {

using synthetic::Sequence;
using synthetic::SequenceOptions;

SequenceOptions MakeOptions(int frames, int width, double noise_sigma) {
  SequenceOptions options;
  options.frames = test::IsShortRun() ? std::min(frames, 12) : frames;
  options.width = test::IsShortRun() ? width / 2 : width;
  options.noise_sigma = noise_sigma;
  return options;
}

Trajectory RunOn(const Sequence& sequence) {
  const auto source = [&](int i) {
    return test::TimedImage{sequence.Render(i), sequence.poses()[i].time_ns};
  };
  return test::RunOdometry(source, sequence.size(), sequence.camera());
}

/// Expects an ATE of at most `max_ate_percent` of the true path length, a share of at least
/// `min_posed_share` posed frames, and a single segment.
void ExpectAccurate(const Sequence& sequence, double max_ate_percent, double min_posed_share) {
  const Trajectory trajectory = RunOn(sequence);
  if (test::IsShortRun()) return;
  EXPECT_GE(trajectory.PosedShare(), min_posed_share);
  for (const FrameResult& frame : trajectory.frames) EXPECT_LE(frame.segment, 0) << frame.index;
  const Evaluation evaluation = test::EvaluatePosed(trajectory, sequence.poses());
  const double ate_percent = 100 * evaluation.absolute.rmse / evaluation.truth_path_length;
  ::testing::Test::RecordProperty("ate_percent", std::to_string(ate_percent));
  EXPECT_LE(ate_percent, max_ate_percent);
}

TEST(SyntheticSequenceTest, RoomIsTrackedAccurately) {
  ExpectAccurate(MakeRoom(MakeOptions(150, 640, 3)), 0.4, 0.95);
}

TEST(SyntheticSequenceTest, StreetIsTrackedAccurately) {
  ExpectAccurate(MakeStreet(MakeOptions(100, 930, 3)), 1.0, 0.95);
}

/// Returns the angle in degrees between the estimated and the true direction in which a camera
/// moves during the first `num_frames` frames after `first_frame`.
double FirstDirectionErrorDeg(int first_frame, int num_frames) {
  SequenceOptions options;
  options.frames = first_frame + num_frames;
  options.width = 620;
  options.noise_sigma = 3;
  options.noise_seed = first_frame + 4;
  const Sequence sequence = MakeStreet(options);
  const auto source = [&](int i) {
    const int frame = first_frame + i;
    return test::TimedImage{sequence.Render(frame), sequence.poses()[frame].time_ns};
  };
  const Trajectory trajectory = test::RunOdometry(source, num_frames, sequence.camera());
  const auto& first = trajectory.frames.front().world_from_camera;
  const auto& last = trajectory.frames.back().world_from_camera;
  if (!first || !last) return 180;
  const Eigen::Vector3d estimate = (first->Inverse() * *last).translation();
  const Eigen::Vector3d truth = (sequence.poses()[first_frame].world_from_camera.Inverse() *
                                 sequence.poses().back().world_from_camera)
                                    .translation();
  return std::atan2(estimate.cross(truth).norm(), estimate.dot(truth)) * 180 / std::numbers::pi;
}

TEST(SyntheticSequenceTest, StreetBeginsInTheTrueDirection) {
  CORVO_SKIP_IF_SHORT();
  // At each of these places a motion to the side explains most matches of the first views, too.
  for (const int first_frame : {182, 737, 884}) {
    EXPECT_LT(FirstDirectionErrorDeg(first_frame, 10), 3) << first_frame;
  }
}

TEST(SyntheticSequenceTest, RoomThroughAFisheyeIsTrackedAccurately) {
  SequenceOptions options = MakeOptions(40, 0, 3);
  CameraParameters fisheye;  // Like TUM-VI's lens, which covers more than 80 degrees off its axis.
  fisheye.model = CameraModel::kKb4;
  fisheye.width = fisheye.height = 480;
  fisheye.fx = fisheye.fy = 180;
  fisheye.cx = fisheye.cy = 239.5;
  fisheye.k1 = 0.0035;
  fisheye.k2 = 0.0007;
  fisheye.k3 = -0.0021;
  fisheye.k4 = 0.0002;
  options.camera = fisheye;
  ExpectAccurate(MakeRoom(options), 0.5, 0.9);
}

/// Makes a walk through the room that is dark for `dark_s` seconds, from 2 s on.
Sequence MakeDarkRoom(double dark_s, std::uint64_t noise_seed) {
  SequenceOptions options = MakeOptions(180, 640, 3);
  options.effects.dark = {2, dark_s};
  options.noise_seed = noise_seed;
  return MakeRoom(options);
}

/// Returns whether at least 50 frames from `end_s` on are posed, all poses are in segment 0, and
/// the ATE is at most 1% of the true path length.
bool IsRecovered(const Trajectory& trajectory, const Sequence& sequence, double end_s) {
  int num_posed_after = 0;
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.world_from_camera && frame.segment != 0) return false;
    num_posed_after += sequence.SecondsAt(frame.index) >= end_s && frame.world_from_camera;
  }
  const Evaluation evaluation = test::EvaluatePosed(trajectory, sequence.poses());
  return num_posed_after >= 50 && evaluation.absolute.rmse <= 0.01 * evaluation.truth_path_length;
}

TEST(SyntheticSequenceTest, TrackIsLostDuringTwoSecondsOfDarkness) {
  const Sequence sequence = MakeDarkRoom(2, 1);
  for (const FrameResult& frame : RunOn(sequence).frames) {
    const double seconds = sequence.SecondsAt(frame.index);
    if (seconds < 2 || seconds >= 4) continue;
    EXPECT_FALSE(frame.world_from_camera) << frame.index;
    EXPECT_EQ(frame.state, State::kLost) << frame.index;
    EXPECT_NE(frame.reason, Reason::kNone) << frame.index;
  }
}

TEST(SyntheticSequenceTest, RecoversFromShortDarknessInTheSameSegment) {
  if (test::IsShortRun()) GTEST_SKIP() << "a short run ends before the darkness";
  constexpr double kDark = 1.4;
  for (int seed = 0; seed < 4; ++seed) {
    const Sequence sequence = MakeDarkRoom(kDark, seed);
    EXPECT_TRUE(IsRecovered(RunOn(sequence), sequence, 2 + kDark)) << seed;
  }
}

TEST(SyntheticSequenceTest, PureRotationIsTrackedWithoutTranslation) {
  const Sequence sequence = MakePureRotation(MakeOptions(60, 640, 3));
  const Trajectory trajectory = RunOn(sequence);
  EXPECT_EQ(trajectory.PosedShare(), 0);
  if (test::IsShortRun()) return;
  int num_said = 0;
  for (const FrameResult& frame : trajectory.frames) {
    num_said += frame.reason == Reason::kRotationOnly;
    if (frame.index == 0) continue;
    ASSERT_TRUE(frame.world_from_camera_rotation) << frame.index;
    EXPECT_THAT(*frame.world_from_camera_rotation,
                test::IsRotationNear(sequence.poses()[frame.index].world_from_camera.rotation(), 1))
        << frame.index;
  }
  EXPECT_GT(num_said, 20);
}

TEST(SyntheticSequenceTest, PlanarWallIsTrackedAccurately) {
  ExpectAccurate(MakePlanarWall(MakeOptions(60, 640, 3)), 1.0, 0.95);
}

}  // namespace
}  // namespace corvo
