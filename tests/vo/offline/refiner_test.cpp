// SPDX-License-Identifier: MIT
#include "vo/offline/refiner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "tests/vo/two_walls.h"

namespace corvo {
namespace {

/// An odometry and the log of its observations.
struct Recorded {
  explicit Recorded(const OdometryOptions& options = {},
                    const Camera& camera = test::PinholeCamera())
      : odometry(camera, options) {
    odometry.SetObservationCallback(log.Callback());
  }

  void Drive(int num_frames, std::uint64_t seed) { Drive(test::MakeDrive(num_frames, seed)); }

  void Drive(const std::vector<cv::Mat>& images) {
    for (const cv::Mat& image : images) odometry.Process(image, time_ns += test::kFrameTime);
    odometry.Finish();
  }

  std::vector<FrameObservations> Logged() const {
    std::vector<FrameObservations> logged;
    log.Visit([&](const FrameObservations& seen) { logged.push_back(seen); });
    return logged;
  }

  Odometry odometry;
  ObservationLog log;
  TimeNs time_ns = 0;
};

/// Returns the RMS position error of the posed frames relative to a straight drive of constant
/// speed, as a share of a step.
double DriveError(const Trajectory& trajectory) {
  const PoseSequence poses = trajectory.PosedFrames();
  const auto position = [&](std::size_t i) { return poses[i].world_from_camera.translation(); };
  const auto last = poses.size() - 1;
  const Eigen::Vector3d step = (position(last) - position(0)) / static_cast<double>(last);
  double sum = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    sum += (position(i) - position(0) - static_cast<double>(i) * step).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(last)) / step.norm();
}

void ExpectSamePoses(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].world_from_camera, b.frames[i].world_from_camera) << i;
  }
}

TEST(RefinerTest, LowersTheCostAndAccountsForEveryFrame) {
  Recorded recorded;
  recorded.Drive(40, 1);
  const Trajectory plain = recorded.odometry.GetTrajectory();
  const Refinement refined = Refine(recorded.odometry, recorded.log);
  ASSERT_TRUE(refined.adjustment.is_usable());
  EXPECT_LT(refined.adjustment.final_cost, refined.adjustment.initial_cost);
  EXPECT_LT(DriveError(refined.trajectory), 1.1 * DriveError(plain));
  EXPECT_GT(refined.landmarks.size(), 100u);
  int num_posed = 0;
  for (std::size_t i = 0; i < plain.frames.size(); ++i) {
    const auto& before = plain.frames[i].world_from_camera;
    const auto& after = refined.trajectory.frames[i].world_from_camera;
    ASSERT_EQ(before.has_value(), after.has_value());
    if (!after) continue;
    ++num_posed;
    EXPECT_EQ(after->rotation(), *refined.trajectory.frames[i].world_from_camera_rotation);
    EXPECT_THAT(*after, test::IsPoseNear(*before, 1.0, 0.1 * plain.frames.size()));
  }
  EXPECT_EQ(refined.num_adjusted + refined.num_placed + refined.num_moved, num_posed);
  EXPECT_GT(refined.num_placed, 0);
  EXPECT_EQ(refined.num_moved, 0);
}

TEST(RefinerTest, NumberOfFramesBetweenKeyframesFollowsTheOptions) {
  Recorded recorded;
  recorded.Drive(40, 1);
  RefinerOptions options;
  options.sequence.frames_between = 0;
  const int num_keyframes = Refine(recorded.odometry, recorded.log, options).num_adjusted;
  EXPECT_EQ(num_keyframes, static_cast<int>(recorded.odometry.map().ActiveKeyframes().size()));
  options.sequence.frames_between = 1;
  const int num_more = Refine(recorded.odometry, recorded.log, options).num_adjusted;
  EXPECT_GT(num_more, num_keyframes);
  EXPECT_LE(num_more, 2 * num_keyframes + 1);
  options.sequence.frames_between = 9;
  options.sequence.max_frames = 2 * num_keyframes;
  EXPECT_EQ(Refine(recorded.odometry, recorded.log, options).num_adjusted, num_more);
  options.sequence.max_frames = num_keyframes;
  EXPECT_EQ(Refine(recorded.odometry, recorded.log, options).num_adjusted, num_keyframes);
}

/// Returns the log with only the first observations of one frame.
ObservationLog Shorten(const Recorded& recorded, int frame, int num_observations) {
  ObservationLog log;
  const ObservationCallback add = log.Callback();
  for (FrameObservations& seen : recorded.Logged()) {
    if (seen.frame == frame) seen.observations.resize(num_observations);
    add(seen);
  }
  return log;
}

/// Returns the number of inliers in a frame after the adjustment of a sequence.
int CountInliers(const Odometry& odometry, const ObservationLog& log, const FrameKey& frame) {
  const SequenceRecord record(odometry, log, {});
  std::vector<Bundle> bundles = record.MakeBundles();
  BundleAdjuster(RefinerOptions().adjustment)
      .Adjust(PriorOf(odometry), odometry.camera().parameters(), bundles, {});
  const auto view = std::distance(record.frames().begin(), record.frames().find(frame));
  return static_cast<int>(
      std::ranges::count_if(bundles.front().observations,
                            [&](const auto& seen) { return seen.view == view && seen.is_inlier; }));
}

TEST(RefinerTest, FramesWithAsManyInliersAsTrackingNeedsAreAdjusted) {
  Recorded recorded;
  recorded.Drive(12, 1);
  const Odometry& odometry = recorded.odometry;
  const SequenceRecord record(odometry, recorded.log, {});
  const auto frame = std::ranges::find_if(
      record.frames(), [](const auto& adjusted) { return adjusted.second.seen.keyframe == kNoId; });
  ASSERT_NE(frame, record.frames().end());
  const int num_frames = static_cast<int>(record.frames().size());
  const int needed = OdometryOptions().tracker.min_inliers;
  std::set<int> counts;
  for (int n = needed - 2; counts.count(needed) == 0 && n < 2 * needed; ++n) {
    const ObservationLog log = Shorten(recorded, frame->first.second, n);
    const int num_inliers = CountInliers(odometry, log, frame->first);
    counts.insert(num_inliers);
    EXPECT_EQ(Refine(odometry, log).num_adjusted, num_frames - (num_inliers < needed)) << n;
  }
  EXPECT_EQ(counts.count(needed), 1u);
  EXPECT_EQ(counts.count(needed - 1), 1u);
}

TEST(RefinerTest, MarginalizedKeyframesAreAdjustedLikeActiveOnes) {
  CORVO_SKIP_IF_SHORT();
  const std::vector<cv::Mat> drive = test::MakeLongDrive(150);
  OdometryOptions options;
  options.calibration.enabled = false;  // Marginalized keyframes do not inform it.
  Recorded everything(options, test::LongDriveCamera());
  everything.Drive(drive);
  options.relocalizer.max_keyframes = 8;
  Recorded newest(options, test::LongDriveCamera());
  newest.Drive(drive);
  std::set<KeyframeId> left;
  for (const FrameObservations& seen : newest.Logged()) {
    if (seen.keyframe == kNoId) continue;
    if (!newest.odometry.map().IsActive(seen.keyframe)) left.insert(seen.keyframe);
    EXPECT_EQ(seen.in_world.size(), seen.observations.size());
  }
  ASSERT_GT(left.size(), 5u);
  const Refinement all = Refine(everything.odometry, everything.log);
  const Refinement some = Refine(newest.odometry, newest.log);
  ASSERT_TRUE(some.adjustment.is_usable());
  EXPECT_EQ(some.num_adjusted, all.num_adjusted);
  EXPECT_NEAR(some.adjustment.num_observations, all.adjustment.num_observations,
              0.01 * all.adjustment.num_observations);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto& expected = all.trajectory.frames[i].world_from_camera;
    if (!expected) continue;
    EXPECT_THAT(*some.trajectory.frames[i].world_from_camera,
                test::IsPoseNear(*expected, 0.01, 0.01))
        << i;
  }
}

TEST(RefinerTest, MergedLandmarksAreReturnedOnce) {
  Recorded recorded;
  recorded.Drive(40, 1);
  std::set<LandmarkId> merged;
  for (const FrameObservations& seen : recorded.Logged()) {
    for (const LandmarkMerge& merge : seen.merges) {
      EXPECT_TRUE(merged.insert(merge.from).second) << "merged twice";
      EXPECT_EQ(merged.count(merge.into), 0u) << "merged into a landmark that no longer exists";
    }
  }
  ASSERT_FALSE(merged.empty());
  for (const MarginalizedLandmark& landmark : Refine(recorded.odometry, recorded.log).landmarks) {
    EXPECT_EQ(merged.count(landmark.id), 0u);
  }
}

TEST(RefinerTest, EachSegmentKeepsThePoseOfItsOldestKeyframe) {
  Recorded recorded;
  recorded.Drive(15, 7);
  recorded.time_ns += 2'000'000'000;
  recorded.Drive(15, 20);
  const Trajectory plain = recorded.odometry.GetTrajectory();
  std::set<int> segments;
  for (const FrameResult& frame : plain.frames) {
    if (frame.world_from_camera) segments.insert(frame.segment);
  }
  ASSERT_EQ(segments.size(), 2u);
  const Refinement refined = Refine(recorded.odometry, recorded.log);
  ASSERT_TRUE(refined.adjustment.is_usable());
  for (const int segment : segments) {
    for (std::size_t i = 0; i < plain.frames.size(); ++i) {
      const FrameResult& frame = plain.frames[i];
      if (frame.segment != segment || !frame.world_from_camera || !frame.is_keyframe) continue;
      EXPECT_THAT(*refined.trajectory.frames[i].world_from_camera,
                  test::IsPoseNear(*frame.world_from_camera, 1e-6, 1e-9))
          << "the oldest keyframe of segment " << segment;
      break;
    }
  }
}

TEST(RefinerTest, FailureReturnsTheUnrefinedTrajectory) {
  Recorded recorded;
  recorded.Drive(20, 1);
  const Refinement refined =
      Refine(recorded.odometry, recorded.log, {}, [](double) { return false; });
  EXPECT_FALSE(refined.adjustment.is_usable());
  EXPECT_EQ(refined.adjustment.camera, recorded.odometry.camera().parameters());
  ExpectSamePoses(refined.trajectory, recorded.odometry.GetTrajectory());
  const Recorded nothing;
  EXPECT_EQ(Refine(nothing.odometry, nothing.log).adjustment.status,
            AdjustmentStatus::kNoObservations);
}

/// The first map depends on texture that moves with the camera: it is discarded, and its frames are
/// located again.
TEST(RefinerTest, OfADiscardedMapNothingIsUsed) {
  std::vector<cv::Mat> images = test::MakeDrive(40, 1);
  const cv::Mat texture = test::MakeTexture(640, 480, 77);
  for (cv::Mat& image : images) texture.rowRange(330, 480).copyTo(image.rowRange(330, 480));
  Recorded recorded;
  recorded.Drive(images);
  const LandmarkId first = recorded.odometry.map().first_landmark_id();
  ASSERT_GT(first, 0) << "a map was discarded";
  for (const FrameObservations& seen : recorded.Logged()) {
    for (const Observation& observation : seen.observations) EXPECT_GE(observation.landmark, first);
  }
  const Refinement refined = Refine(recorded.odometry, recorded.log);
  ASSERT_TRUE(refined.adjustment.is_usable());
  EXPECT_EQ(refined.trajectory.PosedShare(), 1);
  EXPECT_LT(DriveError(refined.trajectory), 1.1 * DriveError(recorded.odometry.GetTrajectory()));
}

TEST(RefinerTest, ObservationsThatCannotBeThoseOfTheOdometryAreErrors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_error = [](const FrameObservations& wrong, const std::string& message) {
    Recorded recorded;
    recorded.Drive(8, 1);
    recorded.log.Callback()(wrong);
    EXPECT_THAT([&] { Refine(recorded.odometry, recorded.log); },
                test::ThrowsError("observations", message));
  };
  const Observation good{0, kNoId, {10, 10}, 1};
  expect_error({100000, 0, kNoId, {good}, {}, {}}, "frame is 100000; allowed is 0 to 7");
  expect_error({-1, 0, kNoId, {good}, {}, {}}, "frame is -1");
  expect_error({1, 0, 1000, {good}, {{0, 0, 1}}, {}}, "keyframe is 1000");
  expect_error({1, 0, 0, {good}, {}, {}}, "number of positions is 0");
  expect_error({1, 0, 0, {good}, {{nan, 0, 1}}, {}}, "not finite");
  expect_error({1, 0, 0, {good}, {{0, 0, 1e300}}, {}}, "a position is not finite");
  expect_error({1, 0, kNoId, {{1 << 30, kNoId, {10, 10}, 1}}, {}, {}}, "landmark is 1073741824");
  expect_error({1, 0, kNoId, {{0, kNoId, {nan, 10}, 1}}, {}, {}}, "pixel");
  expect_error({1, 0, kNoId, {{0, kNoId, {10, 5000}, 1}}, {}, {}}, "pixel");
  expect_error({1, 0, kNoId, {{0, kNoId, {10, 10}, 0}}, {}, {}}, "sigma_px");
  expect_error({1, 0, kNoId, {}, {}, {{3, 4}, {4, 3}}}, "merged into itself");
}

TEST(RefinerTest, ObservationsOfAnotherSequenceAreErrors) {
  Recorded one, other;
  one.Drive(12, 1);
  other.Drive(12, 7);
  EXPECT_THAT([&] { Refine(one.odometry, other.log); }, test::ThrowsError("observations"));
  Recorded longer;
  longer.Drive(20, 1);
  EXPECT_THAT([&] { Refine(one.odometry, longer.log); }, test::ThrowsError("observations"));
  const ObservationLog none;
  EXPECT_THAT([&] { Refine(one.odometry, none); }, test::ThrowsError("observations"));
  EXPECT_TRUE(Refine(one.odometry, one.log).adjustment.is_usable());
}

TEST(RefinerTest, OptionsOutOfRangeAreErrors) {
  Recorded recorded;
  recorded.Drive(8, 1);
  RefinerOptions options;
  options.adjustment.huber_sigmas = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { Refine(recorded.odometry, recorded.log, options); },
              test::ThrowsError("adjustment.huber_sigmas is nan"));
  options = {};
  options.sequence.frames_between = -1;
  EXPECT_THAT([&] { Refine(recorded.odometry, recorded.log, options); },
              test::ThrowsError("frames_between is -1"));
}

TEST(RefinerTest, ResultIsIdenticalWhenRepeated) {
  const auto refine = [] {
    Recorded recorded;
    recorded.Drive(20, 1);
    return Refine(recorded.odometry, recorded.log);
  };
  const Refinement first = refine(), second = refine();
  ExpectSamePoses(first.trajectory, second.trajectory);
  EXPECT_EQ(first.adjustment.camera, second.adjustment.camera);
  EXPECT_EQ(first.adjustment.estimate.covariance, second.adjustment.estimate.covariance);
}

TEST(RefinerTest, AFixedCameraIsNotChanged) {
  OdometryOptions options;
  options.calibration.enabled = false;
  Recorded recorded(options);
  recorded.Drive(20, 1);
  EXPECT_EQ(PriorOf(recorded.odometry).num_free(), 0);
  const Refinement refined = Refine(recorded.odometry, recorded.log);
  ASSERT_TRUE(refined.adjustment.is_usable());
  EXPECT_EQ(refined.adjustment.camera, test::PinholeCamera().parameters());
}

}  // namespace
}  // namespace corvo
