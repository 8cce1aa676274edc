// SPDX-License-Identifier: MIT
#include "vo/offline/log_check.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/vo/two_walls.h"

namespace corvo {
namespace {

class LogCheckTest : public ::testing::Test {
 protected:
  LogCheckTest() {
    TimeNs time_ns = 0;
    for (const cv::Mat& image : test::MakeDrive(8, 1)) {
      odometry_.Process(image, time_ns += 100'000'000);
    }
    odometry_.Finish();
    keyframe_ = odometry_.map().ActiveKeyframes().back();
  }

  const Frame& frame() const { return odometry_.map().keyframe(keyframe_).frame; }

  /// Returns a log of the newest keyframe's frame, with observations on `num_found` of its
  /// keypoints and `num_others` beside one.
  ObservationLog MakeLog(int num_found, int num_others) const {
    FrameObservations seen;
    seen.frame = frame().index;
    for (int k = 0; k < num_found; ++k)
      seen.observations.push_back({0, kNoId, frame().pixel(k), 1});
    for (int k = 0; k < num_others; ++k) {
      const Eigen::Vector2d beside = frame().pixel(k) + Eigen::Vector2d(0.25, 0.125);
      seen.observations.push_back({0, kNoId, beside, 1});
    }
    ObservationLog log;
    log.Callback()(seen);
    return log;
  }

  Odometry odometry_{test::PinholeCamera()};
  KeyframeId keyframe_ = kNoId;
};

TEST_F(LogCheckTest, HalfOfTheObservationsHaveToBeOnKeypoints) {
  const Trajectory trajectory = odometry_.GetTrajectory();
  EXPECT_NO_THROW(CheckLog(odometry_, trajectory, MakeLog(10, 0)));
  EXPECT_NO_THROW(CheckLog(odometry_, trajectory, MakeLog(10, 10)));
  EXPECT_THAT([&] { CheckLog(odometry_, trajectory, MakeLog(10, 11)); },
              test::ThrowsError("10 of 21 in its active keyframes lie on a keypoint"));
  EXPECT_THAT([&] { CheckLog(odometry_, trajectory, MakeLog(0, 0)); },
              test::ThrowsError("0 of 0 in its active keyframes"));
}

}  // namespace
}  // namespace corvo
