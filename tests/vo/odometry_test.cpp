// SPDX-License-Identifier: MIT
#include "vo/odometry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "tests/vo/two_walls.h"

namespace corvo {
namespace {

using test::MakeDrive;
using test::TwoWalls;

Trajectory RunDrive(const std::vector<cv::Mat>& images, int threads) {
  Odometry odometry(test::PinholeCamera(), OdometryOptions(), threads);
  TimeNs time_ns = 0;
  for (const cv::Mat& image : images) odometry.Process(image, time_ns += test::kFrameTime);
  return odometry.Finish();
}

void ExpectIdentical(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].world_from_camera, b.frames[i].world_from_camera) << i;
    EXPECT_EQ(a.frames[i].num_inliers, b.frames[i].num_inliers) << i;
  }
}

TEST(OdometryTest, TracksASteadyDrive) {
  const Trajectory trajectory = RunDrive(MakeDrive(25, 1), 1);
  ASSERT_EQ(trajectory.frames.size(), 25u);
  EXPECT_GE(trajectory.PosedShare(), 0.9);
  const PoseSequence poses = trajectory.PosedFrames();
  const Eigen::Vector3d whole =
      poses.back().world_from_camera.translation() - poses.front().world_from_camera.translation();
  const Eigen::Vector3d step(whole.norm() / static_cast<double>(poses.size() - 1), 0, 0);
  double sum_of_squares = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector3d moved =
        poses[i].world_from_camera.translation() - poses[i - 1].world_from_camera.translation();
    EXPECT_THAT(moved, test::IsMatrixNear(step, 0.3 * step.x())) << i;
    sum_of_squares += (moved - step).squaredNorm();
  }
  EXPECT_LT(std::sqrt(sum_of_squares / static_cast<double>(poses.size() - 1)), 0.1 * step.x());
}

TEST(OdometryTest, ResultIsIdenticalForAnyNumberOfThreads) {
  const std::vector<cv::Mat> drive = MakeDrive(15, 2);
  const Trajectory once = RunDrive(drive, 1);
  EXPECT_GT(once.PosedShare(), 0.5);
  ExpectIdentical(once, RunDrive(drive, 1));
  ExpectIdentical(once, RunDrive(drive, 2));
}

/// Returns the drive with a frame without an image in the place of each of these.
Trajectory RunDriveWithout(const std::vector<int>& missing, const std::vector<cv::Mat>& images) {
  Odometry odometry(test::PinholeCamera());
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    const TimeNs time_ns = (i + 1) * test::kFrameTime;
    if (std::ranges::count(missing, i) == 0) {
      odometry.Process(images[i], time_ns);
    } else {
      const FrameResult frame = odometry.ProcessMissing(time_ns, Reason::kUnreadableImage);
      EXPECT_EQ(frame.index, i);
      EXPECT_FALSE(frame.world_from_camera);
    }
  }
  return odometry.Finish();
}

TEST(OdometryTest, TracksOnAfterMissingImages) {
  const std::vector<cv::Mat> images = MakeDrive(25, 1);
  const std::vector<int> missing = {0, 3, 12, 13, 24};
  const Trajectory trajectory = RunDriveWithout(missing, images);
  ASSERT_EQ(trajectory.frames.size(), images.size());
  EXPECT_EQ(trajectory.Segments().size(), 1u);
  for (int i = 0; i < 25; ++i) {
    const FrameResult& frame = trajectory.frames[i];
    const bool is_missing = std::ranges::count(missing, i) > 0;
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.time_ns, (i + 1) * test::kFrameTime);
    EXPECT_EQ(frame.world_from_camera.has_value(), !is_missing) << i;
    EXPECT_EQ(frame.reason, is_missing ? Reason::kUnreadableImage : Reason::kNone) << i;
  }
}

TEST(OdometryTest, AnImageCanRepeatTheOneBeforeAMissingOne) {
  std::vector<cv::Mat> images = MakeDrive(25, 1);
  images[14] = images[12];
  const Trajectory trajectory = RunDriveWithout({13}, images);
  EXPECT_EQ(trajectory.frames[14].repeats, 12);
  EXPECT_EQ(trajectory.frames[14].world_from_camera, trajectory.frames[12].world_from_camera);
  EXPECT_TRUE(trajectory.frames[14].world_from_camera);
}

TEST(OdometryTest, RejectsAMissingImageWithAnotherReasonOrTime) {
  Odometry odometry(test::PinholeCamera());
  odometry.ProcessMissing(1, Reason::kWrongSize);
  EXPECT_THROW(odometry.ProcessMissing(2, Reason::kTooFewInliers), Error);
  EXPECT_THROW(odometry.ProcessMissing(1, Reason::kWrongSize), Error);
  EXPECT_EQ(odometry.GetTrajectory().frames.size(), 1u);
}

TEST(OdometryTest, InterleavedInstancesDoNotAffectEachOther) {
  const std::vector<cv::Mat> first = MakeDrive(15, 3), second = MakeDrive(15, 30);
  Odometry a(test::PinholeCamera()), b(test::PinholeCamera());
  for (int i = 0; i < 15; ++i) {
    a.Process(first[i], (i + 1) * test::kFrameTime);
    b.Process(second[i], (i + 1) * test::kFrameTime);
  }
  ExpectIdentical(a.Finish(), RunDrive(first, 1));
  ExpectIdentical(b.Finish(), RunDrive(second, 1));
}

TEST(OdometryTest, AfterResetTheResultIsThatOfANewInstance) {
  const std::vector<cv::Mat> images = MakeDrive(6, 1);
  Odometry odometry(test::PinholeCamera());
  for (int i = 0; i < 4; ++i) odometry.Process(images[5 - i], (i + 1) * test::kFrameTime);
  odometry.Reset();
  EXPECT_EQ(odometry.map().num_keyframes(), 0);
  TimeNs time_ns = 0;
  for (const cv::Mat& image : images) odometry.Process(image, time_ns += test::kFrameTime);
  ExpectIdentical(odometry.Finish(), RunDrive(images, 1));
}

TEST(OdometryTest, LastFrameRefersToExistingLandmarksOnly) {
  const std::vector<cv::Mat> images = MakeDrive(8, 1);
  Odometry odometry(test::PinholeCamera());
  EXPECT_EQ(odometry.last_frame().num_keypoints(), 0);
  for (int i = 0; i < 8; ++i) {
    const FrameResult result = odometry.Process(images[i], (i + 1) * test::kFrameTime);
    const Frame& frame = odometry.last_frame();
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.num_keypoints(), result.num_features);
    EXPECT_EQ(CountObservedLandmarks(frame) > 0, result.world_from_camera.has_value());
    for (const LandmarkId id : frame.landmarks) {
      if (id != kNoId) {
        ASSERT_NE(odometry.map().FindLandmark(id), nullptr);
      }
    }
  }
}

TEST(OdometryTest, FramesOfAStaticCameraHaveNoPose) {
  const cv::Mat image = TwoWalls(5).Render(0);
  const Trajectory trajectory = RunDrive(std::vector<cv::Mat>(10, image), 1);
  EXPECT_EQ(trajectory.PosedShare(), 0);
  EXPECT_EQ(trajectory.frames.back().reason, Reason::kLowParallax);
}

TEST(OdometryTest, RepeatedFramesHaveThePoseOfTheirOriginalAndDisturbNothing) {
  constexpr int kRepeats = 3;
  const std::vector<cv::Mat> drive = MakeDrive(25, 1);
  std::vector<cv::Mat> repeated;
  for (const cv::Mat& image : drive) {
    repeated.insert(repeated.end(), kRepeats, image);
    repeated.back() = image + cv::Scalar(1);  // As a codec may leave it.
  }
  const Trajectory once = RunDrive(drive, 1);
  const Trajectory all = RunDrive(repeated, 1);
  EXPECT_EQ(all.PosedShare(), 1);
  const double scale = all.frames.back().world_from_camera->translation().norm() /
                       once.frames.back().world_from_camera->translation().norm();
  for (int i = 0; i < static_cast<int>(all.frames.size()); ++i) {
    const FrameResult& frame = all.frames[i];
    const int original = i - i % kRepeats;
    EXPECT_EQ(frame.repeats, i == original ? kNoId : original);
    EXPECT_EQ(frame.world_from_camera, all.frames[original].world_from_camera);
    EXPECT_EQ(frame.reason, i == original ? Reason::kNone : Reason::kRepeatedImage);
    const Eigen::Vector3d expected =
        scale * once.frames[i / kRepeats].world_from_camera->translation();
    EXPECT_NEAR((frame.world_from_camera->translation() - expected).norm(), 0, 0.02 * scale);
  }
}

/// Returns the images of a drive with texture that moves with the camera from row `first_row` on.
std::vector<cv::Mat> MakeCoveredDrive(int first_row) {
  const cv::Mat texture = test::MakeTexture(640, 480, 77);
  std::vector<cv::Mat> covered;
  for (const cv::Mat& image : MakeDrive(40, 1)) {
    covered.push_back(image.clone());
    texture.rowRange(first_row, 480).copyTo(covered.back().rowRange(first_row, 480));
  }
  return covered;
}

TEST(OdometryTest, TextureThatMovesWithTheCameraIsMaskedAndDoesNotHoldTheCamera) {
  const Trajectory trajectory = RunDrive(MakeCoveredDrive(330), 1);
  // The first map, which depended on the texture, was discarded, and its frames located again.
  EXPECT_EQ(trajectory.PosedShare(), 1);
  EXPECT_NEAR(trajectory.frames.back().masked_share, 150. / 480, 0.1);
  const PoseSequence poses = trajectory.PosedFrames();
  const Eigen::Vector3d whole =
      poses.back().world_from_camera.translation() - poses.front().world_from_camera.translation();
  EXPECT_NEAR(whole.normalized().x(), 1, 0.01);
  for (std::size_t i = 10; i < poses.size(); ++i) {
    const Eigen::Vector3d moved =
        poses[i].world_from_camera.translation() - poses[i - 10].world_from_camera.translation();
    EXPECT_NEAR(moved.norm(), 10 * whole.norm() / (poses.size() - 1.0), 0.1 * moved.norm()) << i;
  }
}

TEST(OdometryTest, LandmarksOfADiscardedMapShareNoIdsWithThoseOfTheNext) {
  Odometry odometry(test::PinholeCamera());
  LandmarkId end_of_discarded = 0;
  TimeNs time_ns = 0;
  for (const cv::Mat& image : MakeCoveredDrive(330)) {
    const LandmarkId first_id = odometry.map().first_landmark_id();
    const int num_ids = odometry.map().num_landmark_ids();
    odometry.Process(image, time_ns += test::kFrameTime);
    if (odometry.map().first_landmark_id() != first_id) end_of_discarded = num_ids;
  }
  ASSERT_GT(end_of_discarded, 0) << "a map was discarded";
  ASSERT_FALSE(odometry.map().empty());
  EXPECT_GE(odometry.map().first_landmark_id(), end_of_discarded);
  for (LandmarkId id = 0; id < end_of_discarded; ++id) {
    EXPECT_EQ(odometry.map().FindLandmark(id), nullptr);
  }
}

TEST(OdometryTest, AnOverlayOverMostOfTheImageIsTheReason) {
  std::vector<cv::Mat> covered = MakeCoveredDrive(220);
  for (std::size_t i = 25; i < covered.size(); ++i) {
    covered[i].rowRange(0, 220) = cv::Scalar(90);
  }
  const FrameResult last = RunDrive(covered, 1).frames.back();
  EXPECT_FALSE(last.world_from_camera);
  EXPECT_EQ(last.reason, Reason::kStaticOverlay);
}

TEST(OdometryTest, ACameraThatStopsAndGoesOnIsTracked) {
  const std::vector<cv::Mat> drive = MakeDrive(30, 2);
  std::vector<cv::Mat> images(drive.begin(), drive.begin() + 15);
  images.insert(images.end(), 40, drive[14]);
  images.insert(images.end(), drive.begin() + 15, drive.end());
  const Trajectory trajectory = RunDrive(images, 1);
  EXPECT_EQ(trajectory.PosedShare(), 1);
  EXPECT_EQ(trajectory.frames.back().segment, 0);
}

TEST(OdometryTest, BlankImageIsReportedAndTrackingContinues) {
  std::vector<cv::Mat> drive = MakeDrive(20, 6);
  drive[12] = cv::Mat(480, 640, CV_8UC1, cv::Scalar(90));
  const Trajectory trajectory = RunDrive(drive, 1);
  EXPECT_EQ(trajectory.frames[12].state, State::kLost);
  EXPECT_EQ(trajectory.frames[12].reason, Reason::kTooFewFeatures);
  EXPECT_FALSE(trajectory.frames[12].world_from_camera);
  for (int i = 13; i < 20; ++i) {
    EXPECT_EQ(trajectory.frames[i].state, State::kTracking) << i;
    EXPECT_EQ(trajectory.frames[i].segment, 0) << i;
  }
}

TEST(OdometryTest, AfterACutANewSegmentContinuesTheOldOne) {
  std::vector<cv::Mat> drive = MakeDrive(15, 7);
  for (const cv::Mat& image : MakeDrive(15, 20)) drive.push_back(image);
  const Trajectory trajectory = RunDrive(drive, 1);
  for (int i = 1; i < 30; ++i) EXPECT_EQ(trajectory.frames[i].segment, i < 15 ? 0 : 1) << i;
  ASSERT_GE(trajectory.PosedShare(), 0.9);
  // The speed is the same before and after the cut: the scale is carried over.
  const auto step = [&](int i) {
    return (trajectory.frames[i].world_from_camera->translation() -
            trajectory.frames[i - 1].world_from_camera->translation())
        .norm();
  };
  EXPECT_NEAR(step(29) / step(13), 1, 0.3);
  EXPECT_GT(trajectory.frames[29].world_from_camera->translation().x(),
            trajectory.frames[13].world_from_camera->translation().x());
}

TEST(OdometryTest, ScaleOfANewSegmentStatesHowItCameAbout) {
  std::vector<cv::Mat> drive = MakeDrive(15, 7);
  for (const cv::Mat& image : MakeDrive(15, 20)) drive.push_back(image);
  const std::vector<Segment> segments = RunDrive(drive, 1).Segments();
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].scale, SegmentScale());
  EXPECT_EQ(segments[1].scale.source, ScaleSource::kMedianSpeed);
  // A steady drive and a gap of more than a second: between the least possible growth and twice it.
  const double growth = OdometryOptions().segment_start.speed_growth;
  EXPECT_GT(segments[1].scale.factor.value(), std::exp(growth));
  EXPECT_LT(segments[1].scale.factor.value(), std::exp(2 * growth));
}

TEST(OdometryTest, ANewSegmentGetsKeyframesLikeTheFirst) {
  CORVO_SKIP_IF_SHORT();
  std::vector<cv::Mat> drive = MakeDrive(25, 7);
  for (const cv::Mat& image : MakeDrive(25, 20)) drive.push_back(image);
  Odometry odometry(test::PinholeCamera());
  for (std::size_t i = 0; i < drive.size(); ++i) {
    odometry.Process(drive[i], static_cast<TimeNs>(i + 1) * test::kFrameTime);
  }
  std::vector<int> num_keyframes(2);
  for (KeyframeId id = 0; id < odometry.map().num_keyframes(); ++id) {
    ++num_keyframes.at(odometry.map().SegmentOf(id));
  }
  constexpr int kFirst = 2;  // Number of keyframes that start a segment.
  EXPECT_GT(num_keyframes[0], kFirst);
  EXPECT_GT(num_keyframes[1], kFirst);
}

TEST(OdometryTest, RelocalizesInTheSameSegmentAfterAJumpBack) {
  std::vector<cv::Mat> drive = MakeDrive(25, 8);
  drive.push_back(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  for (int i = 8; i < 14; ++i) drive.push_back(drive[i]);  // Jumps back to a known place.
  const Trajectory trajectory = RunDrive(drive, 1);
  for (int i = 0; i < 6; ++i) {
    const FrameResult& before = trajectory.frames[8 + i];
    const FrameResult& after = trajectory.frames[26 + i];
    ASSERT_TRUE(before.world_from_camera && after.world_from_camera) << i;
    EXPECT_EQ(after.segment, 0) << i;
    EXPECT_THAT(*after.world_from_camera, test::IsPoseNear(*before.world_from_camera, 0.3, 0.02));
  }
}

TEST(OdometryTest, ANewSegmentWaitsForMaxLostTime) {
  CORVO_SKIP_IF_SHORT();
  std::vector<cv::Mat> drive = MakeDrive(12, 7);
  for (const cv::Mat& image : MakeDrive(12, 20)) drive.push_back(image);
  for (const double max_lost_s : {0.0, 0.5, 10.0}) {
    OdometryOptions options;
    options.relocalizer.max_lost_s = max_lost_s;
    Odometry odometry(test::PinholeCamera(), options);
    double started_s = 100;
    for (int i = 0; i < 24; ++i) {
      const FrameResult result = odometry.Process(drive[i], (i + 1) * test::kFrameTime);
      if (result.segment == 1) started_s = std::min(started_s, 0.1 * (i - 11));
    }
    EXPECT_GE(started_s, max_lost_s);
    if (max_lost_s <= 0.5) {
      EXPECT_LE(started_s, max_lost_s + 0.5);
    }
  }
}

TEST(OdometryTest, OnALongDriveMarginalizationBoundsMemoryAndKeepsTheTrajectory) {
  CORVO_SKIP_IF_SHORT();
  constexpr int kFrames = 300;
  const std::vector<cv::Mat> drive = test::MakeLongDrive(kFrames);
  OdometryOptions options;
  options.calibration.enabled = false;  // Marginalized keyframes do not inform it.
  Odometry everything(test::LongDriveCamera(), options);
  options.relocalizer.max_keyframes = 16;
  Odometry newest(test::LongDriveCamera(), options);
  std::set<LandmarkId> finished;
  newest.SetLandmarkCallback([&](const MarginalizedLandmark& landmark) {
    EXPECT_TRUE(finished.insert(landmark.id).second);
  });
  std::vector<double> bytes;
  for (int i = 0; i < kFrames; ++i) {
    everything.Process(drive[i], (i + 1) * test::kFrameTime);
    newest.Process(drive[i], (i + 1) * test::kFrameTime);
    bytes.push_back(static_cast<double>(newest.memory_use().working_set_bytes));
  }
  EXPECT_GE(everything.GetTrajectory().PosedShare(), 0.9);
  ExpectIdentical(everything.GetTrajectory(), newest.GetTrajectory());
  EXPECT_LT(newest.map().ActiveKeyframes().size(),
            0.75 * everything.map().ActiveKeyframes().size());
  const auto largest = [&](int begin, int end) {
    return *std::max_element(bytes.begin() + begin, bytes.begin() + end);
  };
  const double second_third = largest(kFrames / 3, 2 * kFrames / 3);
  EXPECT_NEAR(largest(2 * kFrames / 3, kFrames), second_third, 0.2 * second_third);
  EXPECT_GT(newest.memory_use().working_set_bytes, newest.map().working_set_bytes());
  EXPECT_EQ(newest.map().num_landmarks() + finished.size(), everything.map().num_landmarks());
  for (const LandmarkId id : finished) EXPECT_EQ(newest.map().FindLandmark(id), nullptr);
}

TEST(OdometryTest, MemoryUseIncludesTheFramesThatWaitForInitialization) {
  Odometry odometry(test::PinholeCamera());
  odometry.Process(MakeDrive(1, 9)[0], test::kFrameTime);
  EXPECT_GT(odometry.memory_use().working_set_bytes,
            odometry.map().working_set_bytes() + 500 * sizeof(orb::Descriptor));
  EXPECT_EQ(odometry.memory_use().working_set_bytes, odometry.map().working_set_bytes() +
                                                         NumBytes(odometry.last_frame()) +
                                                         NumBytes(Frame()) + 640 * 480)
      << "the map, the frame that waits, a previous frame, which is empty, and a copy of the image";
}

TEST(OdometryTest, CopiesOfLargeFirstImagesAreBounded) {
  Odometry odometry(test::PinholeCamera().Resized(4000, 3000));
  const int num_images = 12;  // Of 12 MB each.
  for (int i = 1; i <= num_images; ++i) {
    cv::Mat image(3000, 4000, CV_8UC1);
    cv::randu(image, 0, 255);
    odometry.Process(image, i * test::kFrameTime);
  }
  EXPECT_LT(odometry.memory_use().working_set_bytes, std::size_t{128} << 20);
}

TEST(OdometryTest, BadInputThrowsAndChangesNothing) {
  const std::vector<cv::Mat> drive = MakeDrive(3, 9);
  Odometry odometry(test::PinholeCamera());
  odometry.Process(drive[0], test::kFrameTime);
  const auto process = [&](const cv::Mat& image, TimeNs time_ns) {
    return [&odometry, image, time_ns] { odometry.Process(image, time_ns); };
  };
  EXPECT_THAT(process(drive[1], test::kFrameTime), test::ThrowsError("frame 1", "100000000 ns"));
  EXPECT_THAT(process(cv::Mat(), 2 * test::kFrameTime), test::ThrowsError("image is", "640x480"));
  EXPECT_THAT(process(cv::Mat(480, 640, CV_8UC3), 2 * test::kFrameTime),
              test::ThrowsError("CV_8UC3"));
  EXPECT_THAT(process(cv::Mat(480, 641, CV_8UC1), 2 * test::kFrameTime),
              test::ThrowsError("641x480", "640x480"));
  EXPECT_EQ(odometry.GetTrajectory().frames.size(), 1u);
  EXPECT_EQ(odometry.Process(drive[1], 2 * test::kFrameTime).index, 1);
}

TEST(OdometryTest, InvalidOptionsThrow) {
  OdometryOptions options;
  options.tracker.min_inliers = 3;
  EXPECT_THAT([&] { Odometry(test::PinholeCamera(), options); },
              test::ThrowsError("tracker.min_inliers", "3"));
}

TEST(OdometryTest, AMovedFromObjectThrowsUntilAnotherIsAssignedToIt) {
  const std::vector<cv::Mat> images = MakeDrive(3, 1);
  Odometry first(test::PinholeCamera());
  first.Process(images[0], test::kFrameTime);
  Odometry second = std::move(first);
  const auto expect_error = [](const std::function<void()>& use) {
    EXPECT_THAT(use, test::ThrowsError("moved from"));
  };
  expect_error([&] { first.Process(images[1], 2 * test::kFrameTime); });
  expect_error([&] { first.Finish(); });
  expect_error([&] { first.Reset(); });
  expect_error([&] { first.GetTrajectory(); });
  expect_error([&] { first.map(); });
  expect_error([&] { first.camera(); });
  expect_error([&] { first.camera_prior(); });
  expect_error([&] { first.camera_estimate(); });
  expect_error([&] { first.prior_rejected(); });
  expect_error([&] { first.options(); });
  expect_error([&] { first.memory_use(); });
  expect_error([&] { first.last_frame(); });
  expect_error([&] { first.SetLandmarkCallback({}); });
  expect_error([&] { first.SetObservationCallback({}); });
  first = std::move(second);
  first.Process(images[1], 2 * test::kFrameTime);
  EXPECT_EQ(first.GetTrajectory().frames.size(), 2u);
  second = Odometry(test::PinholeCamera());
  second.Process(images[0], test::kFrameTime);
  EXPECT_EQ(second.Finish().frames.size(), 1u);
}

TEST(OdometryTest, TimesWhoseDifferencesOverflowAreErrors) {
  const cv::Mat image = MakeDrive(1, 1)[0];
  for (const TimeNs time_ns :
       {std::numeric_limits<TimeNs>::min(), std::numeric_limits<TimeNs>::max()}) {
    Odometry odometry(test::PinholeCamera());
    EXPECT_THAT([&] { odometry.Process(image, time_ns); }, test::ThrowsError("time of a frame"));
    EXPECT_TRUE(odometry.GetTrajectory().frames.empty());
  }
}

}  // namespace
}  // namespace corvo
