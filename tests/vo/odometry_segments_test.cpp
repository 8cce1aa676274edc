// SPDX-License-Identifier: MIT
// Films with cuts, whose later parts show places that earlier parts have shown.
#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "tests/vo/two_walls.h"
#include "vo/odometry.h"
#include "vo/offline/refiner.h"

namespace corvo {
namespace {

using test::MakeDrive;
using test::TwoWalls;
using ::testing::Each;
using ::testing::Field;

constexpr int kFirstPart = 25;
constexpr double kFirstStep = 0.1;

/// Returns the camera's position in each image of a film: after a first drive, a cut to a place
/// further on, from where the camera drives back, faster, to where the first drive was.
std::vector<double> PositionsOfReturn() {
  constexpr double kSecondStep = 0.15;
  std::vector<double> positions;
  for (int i = 0; i < kFirstPart; ++i) positions.push_back(kFirstStep * i);
  for (double x = 13; x > -1; x -= kSecondStep) positions.push_back(x);
  return positions;
}

std::vector<cv::Mat> RenderReturn() {
  const TwoWalls walls(7, 2800);
  std::vector<cv::Mat> images;
  for (const double x : PositionsOfReturn()) images.push_back(walls.Render(x));
  return images;
}

/// Returns a drive, a cut to other walls, and a cut back to the first ones.
std::vector<cv::Mat> MakeCutBack() {
  const std::vector<cv::Mat> first = MakeDrive(kFirstPart, 7);
  std::vector<cv::Mat> images = first;
  for (const cv::Mat& image : MakeDrive(kFirstPart, 20)) images.push_back(image);
  images.insert(images.end(), first.begin() + 10, first.end());
  return images;
}

Trajectory RunFilm(const std::vector<cv::Mat>& images, int threads = 1) {
  Odometry odometry(test::PinholeCamera(), OdometryOptions(), threads);
  TimeNs time_ns = 0;
  for (const cv::Mat& image : images) odometry.Process(image, time_ns += test::kFrameTime);
  return odometry.Finish();
}

/// Expects that the posed frames of a film of a return are where they were rendered, in the unit of
/// the first drive.
void ExpectPositions(const Trajectory& trajectory, double tolerance) {
  const std::vector<double> positions = PositionsOfReturn();
  const auto estimated = [&](int i) {
    return trajectory.frames[i].world_from_camera->translation().x();
  };
  constexpr int kLast = kFirstPart - 1;
  const double unit = (estimated(kLast) - estimated(0)) / (positions[kLast] - positions[0]);
  for (int i = 0; i < static_cast<int>(positions.size()); ++i) {
    if (!trajectory.frames[i].world_from_camera) continue;
    EXPECT_NEAR((estimated(i) - estimated(0)) / unit, positions[i], tolerance) << i;
  }
}

TEST(OdometrySegmentsTest, ASegmentThatSeesAnEarlierOneIsJoinedWithItInItsScale) {
  Odometry odometry(test::PinholeCamera());
  std::set<int> segments_when_posed;
  TimeNs time_ns = 0;
  for (const cv::Mat& image : RenderReturn()) {
    const FrameResult frame = odometry.Process(image, time_ns += test::kFrameTime);
    if (frame.world_from_camera) segments_when_posed.insert(frame.segment);
  }
  EXPECT_THAT(segments_when_posed, ::testing::ElementsAre(0, 1));
  const Trajectory trajectory = odometry.Finish();
  EXPECT_GT(trajectory.PosedShare(), 0.85);
  ASSERT_EQ(trajectory.Segments().size(), 1u);
  EXPECT_EQ(odometry.map().NewestSegment(), 0);
  for (const FrameResult& frame : trajectory.frames) EXPECT_EQ(frame.segment, 0) << frame.index;
  ExpectPositions(trajectory, 0.05);
}

TEST(OdometrySegmentsTest, AJoinedRunIsTheSameForAnyNumberOfThreads) {
  CORVO_SKIP_IF_SHORT();
  const std::vector<cv::Mat> images = RenderReturn();
  const Trajectory one = RunFilm(images, 1), two = RunFilm(images, 2);
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(one.frames[i].world_from_camera, two.frames[i].world_from_camera) << i;
  }
}

TEST(OdometrySegmentsTest, AJoinedRunIsRefinedAsOneSegment) {
  CORVO_SKIP_IF_SHORT();
  Odometry odometry(test::PinholeCamera());
  ObservationLog log;
  odometry.SetObservationCallback(log.Callback());
  TimeNs time_ns = 0;
  for (const cv::Mat& image : RenderReturn()) odometry.Process(image, time_ns += test::kFrameTime);
  odometry.Finish();
  const Refinement refined = Refine(odometry, log);
  ASSERT_TRUE(refined.adjustment.is_usable());
  EXPECT_EQ(refined.trajectory.Segments().size(), 1u);
  EXPECT_THAT(refined.landmarks, Each(Field(&MarginalizedLandmark::segment, 0)));
  EXPECT_EQ(refined.num_moved, 0);
  ExpectPositions(refined.trajectory, 0.02);
}

TEST(OdometrySegmentsTest, AfterACutBackTrackingContinuesInTheEarlierSegment) {
  const Trajectory trajectory = RunFilm(MakeCutBack());
  ASSERT_EQ(trajectory.Segments().size(), 2u);
  EXPECT_EQ(trajectory.frames[2 * kFirstPart - 1].segment, 1);
  for (int i = 10; i < kFirstPart; ++i) {
    const FrameResult& before = trajectory.frames[i];
    const FrameResult& after = trajectory.frames[2 * kFirstPart + i - 10];
    ASSERT_TRUE(before.world_from_camera && after.world_from_camera) << i;
    EXPECT_EQ(after.segment, 0) << i;
    EXPECT_NE(after.reason, Reason::kScaleUncertain) << i;
    EXPECT_THAT(*after.world_from_camera, test::IsPoseNear(*before.world_from_camera, 0.3, 0.02));
  }
}

TEST(OdometrySegmentsTest, AfterAReturnANewSegmentGetsANewIndex) {
  std::vector<cv::Mat> images = MakeCutBack();
  for (const cv::Mat& image : MakeDrive(kFirstPart, 33)) images.push_back(image);
  const Trajectory trajectory = RunFilm(images);
  EXPECT_EQ(trajectory.Segments().size(), 3u);
  EXPECT_EQ(trajectory.frames.back().segment, 2);
}

}  // namespace
}  // namespace corvo
