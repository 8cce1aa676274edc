// SPDX-License-Identifier: MIT
// Runs the complete odometry on public sequences with ground truth.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/dataset/image_source.h"
#include "apps/run/sequence_stream.h"
#include "tests/support/data.h"
#include "tests/system/disturbances.h"
#include "tests/system/sequence_runner.h"
#include "vo/io/config.h"
#include "vo/io/trajectory_io.h"
#include "vo/odometry.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// A dataset folder; a short run uses only its first `max_short_frames` frames.
struct Folder {
  Folder(const std::string& folder, int max_short_frames)
      : list(ListImages(test::DataPath(folder))), num_frames(static_cast<int>(list.images.size())) {
    if (test::IsShortRun()) num_frames = std::min(num_frames, max_short_frames);
  }

  test::ImageSource Source() const {
    return [this](int i) {
      return test::TimedImage{ReadGrayImage(list.images[i].file), list.images[i].time_ns};
    };
  }

  ImageList list;
  int num_frames;
};

Trajectory RunOnFolder(const std::string& name, const Camera* camera, int max_short_frames) {
  const Folder folder(name, max_short_frames);
  return test::RunOdometry(folder.Source(), folder.num_frames,
                           camera ? *camera : Camera(*folder.list.camera));
}

/// Returns body_from_camera of EuRoC's left camera, as published with the dataset
/// (cam0/sensor.yaml).
SE3 EurocBodyFromCamera() {
  Eigen::Matrix3d rotation;
  rotation << 0.0148655429818, -0.999880929698, 0.00414029679422, 0.999557249008, 0.0149672133247,
      0.025715529948, -0.0257744366974, 0.00375618835797, 0.999660727178;
  return SE3(SO3(rotation), {-0.0216401454975, -0.064676986768, 0.00981073058949});
}

PoseSequence ReadEurocTruth(const fs::path& file) {
  PoseSequence truth = ReadEurocPoses(file);
  for (TimedPose& pose : truth) {
    pose.world_from_camera = pose.world_from_camera * EurocBodyFromCamera();
  }
  return truth;
}

void ExpectAccurate(const Trajectory& trajectory, const PoseSequence& truth, double max_ate,
                    double min_posed_share) {
  if (test::IsShortRun()) return;
  EXPECT_GE(trajectory.PosedShare(), min_posed_share);
  const Evaluation evaluation = test::EvaluatePosed(trajectory, truth);
  ::testing::Test::RecordProperty("ate", std::to_string(evaluation.absolute.rmse));
  EXPECT_LE(evaluation.absolute.rmse, max_ate);
}

TEST(RealSequenceTest, Kitti03CountryRoadIsTrackedAccurately) {
  CORVO_REQUIRE_DATA("kitti/sequences/03");
  ExpectAccurate(RunOnFolder("kitti/sequences/03", nullptr, 8), test::ReadKittiTruth("03"), 0.45,
                 0.997);
}

/// Runs on every `step`-th image, starting once from each of the first four images, and expects
/// every run to be accurate.
void ExpectAccurateWithEvery(int step, const std::string& kitti_sequence, double max_ate) {
  const Folder folder("kitti/sequences/" + kitti_sequence, 8);
  const test::ImageSource all = folder.Source();
  const PoseSequence truth = test::ReadKittiTruth(kitti_sequence);
  for (int start = 0; start < 4; ++start) {
    SCOPED_TRACE(start);
    const Trajectory trajectory = test::RunOdometry([&](int i) { return all(start + step * i); },
                                                    (folder.num_frames - start + step - 1) / step,
                                                    Camera(*folder.list.camera));
    ExpectAccurate(trajectory, truth, max_ate, 0.99);
  }
}

TEST(RealSequenceTest, Kitti03KeepsItsScaleAtHalfTheFrameRate) {
  CORVO_REQUIRE_DATA("kitti/sequences/03");
  ExpectAccurateWithEvery(2, "03", 0.6);
}

/// The camera moves by 3 m from one image to the next.
TEST(RealSequenceTest, Kitti03KeepsItsScaleAtAQuarterOfTheFrameRate) {
  CORVO_REQUIRE_DATA("kitti/sequences/03");
  ExpectAccurateWithEvery(4, "03", 0.9);
}

/// The camera turns by up to 10 degrees from one image to the next.
TEST(RealSequenceTest, Kitti05KeepsItsScaleAtAThirdOfTheFrameRate) {
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  ExpectAccurateWithEvery(3, "05", 0.2);
}

TEST(RealSequenceTest, Kitti05SharpTurnIsTrackedAccurately) {
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  ExpectAccurate(RunOnFolder("kitti/sequences/05", nullptr, 8), test::ReadKittiTruth("05"), 0.08,
                 0.98);
}

/// Returns the images of a dataset from one of them on, without the truth.
test::Recording ReadImages(const Folder& folder, int first) {
  test::Recording recording;
  for (int i = first; i < folder.num_frames; ++i) recording.images.push_back(folder.Source()(i));
  return recording;
}

/// Runs on images that were made from those of a dataset, with its camera.
Trajectory RunOnImages(const test::Recording& recording, const Folder& folder) {
  return test::RunOdometry([&](int i) { return recording.images[i]; }, recording.size(),
                           Camera(*folder.list.camera));
}

/// A vehicle crosses 41% of the image in 40 frames, while the camera turns into another street.
TEST(RealSequenceTest, Kitti05IsTrackedAccuratelyBehindACrossingVehicle) {
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  const Folder folder("kitti/sequences/05", 20);
  const test::Recording recording = ReadImages(folder, 0);
  for (std::uint64_t seed = 1; seed <= (test::IsShortRun() ? 1 : 4); ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    const test::Vehicle vehicle{test::VehicleMotion::kCrossing, 12, 40, 0.41};
    const test::Recording disturbed = test::AddVehicle(recording, vehicle, random);
    const Trajectory trajectory = RunOnImages(disturbed, folder);
    ExpectAccurate(trajectory, test::ReadKittiTruth("05"), 0.08, 0.98);
  }
}

/// The bottom of the image moves with the camera. From the later images on, in the turn, the first
/// map is made before that is found.
TEST(RealSequenceTest, Kitti05IsTrackedAccuratelyAboveABonnet) {
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  const Folder folder("kitti/sequences/05", 30);
  for (const int first : {0, 9, 13, 15, 16, 17, 18, 19}) {
    SCOPED_TRACE(first);
    test::Random random(1);
    const test::Recording disturbed = test::AddOverlay(ReadImages(folder, first), 0.2, random);
    const Trajectory trajectory = RunOnImages(disturbed, folder);
    ExpectAccurate(trajectory, test::ReadKittiTruth("05"), 0.08, 0.98);
  }
}

TEST(RealSequenceTest, Kitti05SharpTurnIsRefinedAccurately) {
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  const Folder folder("kitti/sequences/05", 8);
  const Refinement refined =
      test::RunAndRefine(folder.Source(), folder.num_frames, Camera(*folder.list.camera));
  EXPECT_TRUE(refined.adjustment.is_usable());
  EXPECT_LT(refined.adjustment.final_cost, refined.adjustment.initial_cost);
  ExpectAccurate(refined.trajectory, test::ReadKittiTruth("05"), 0.06, 0.98);
}

TEST(RealSequenceTest, Kitti06StraightRoadIsTrackedAccurately) {
  CORVO_REQUIRE_DATA("kitti/sequences/06");
  ExpectAccurate(RunOnFolder("kitti/sequences/06", nullptr, 12), test::ReadKittiTruth("06"), 0.06,
                 0.98);
}

TEST(RealSequenceTest, SevenScenesHandHeldCameraIsTrackedAccurately) {
  CORVO_REQUIRE_DATA("7scenes/redkitchen");
  const Camera camera = ReadCameraFile(test::SourceDir() / "configs" / "7scenes.yaml").camera;
  const Trajectory trajectory = RunOnFolder("7scenes/redkitchen", &camera, 5);
  const fs::path truth = test::DataPath("7scenes/redkitchen/groundtruth.txt");
  ExpectAccurate(trajectory, ReadTum(truth), 0.045, 0.98);
}

TEST(RealSequenceTest, EurocDroneIsTrackedAccurately) {
  CORVO_REQUIRE_DATA("euroc/MH_01_easy");
  const Trajectory trajectory = RunOnFolder("euroc/MH_01_easy/mav0", nullptr, 12);
  const fs::path truth =
      test::DataPath("euroc/MH_01_easy/mav0/state_groundtruth_estimate0/data.csv");
  ExpectAccurate(trajectory, ReadEurocTruth(truth), 0.008, 0.98);
}

TEST(RealSequenceTest, EurocFramesOfAStaticCameraHaveNoPose) {
  CORVO_REQUIRE_DATA("euroc/V1_01_easy");
  const Trajectory trajectory = RunOnFolder("euroc/V1_01_easy/mav0", nullptr, 6);
  EXPECT_EQ(trajectory.PosedShare(), 0);
  EXPECT_EQ(trajectory.frames.back().reason, Reason::kLowParallax);
}

/// Returns the rotation of each frame that has one, as a pose at the origin.
PoseSequence RotationsOf(const Trajectory& trajectory) {
  PoseSequence rotations;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera_rotation) continue;
    rotations.push_back(
        {frame.time_ns, SE3(*frame.world_from_camera_rotation, Eigen::Vector3d::Zero())});
  }
  return rotations;
}

TEST(RealSequenceTest, RotationIsTrackedWhileTheCameraOnlyTurns) {
  const std::string folder = "tum/rgbd_dataset_freiburg1_rpy";
  CORVO_REQUIRE_DATA(folder);
  const Camera camera = ReadCameraFile(test::SourceDir() / "configs" / "tum_fr1.yaml").camera;
  const Trajectory trajectory = RunOnFolder(folder, &camera, 6);
  for (const FrameResult& frame : trajectory.frames) {
    EXPECT_EQ(frame.reason == Reason::kNone, frame.world_from_camera.has_value()) << frame.index;
    const bool is_turning = frame.state == State::kTracking || frame.state == State::kRotationOnly;
    EXPECT_EQ(is_turning, frame.world_from_camera_rotation.has_value()) << frame.index;
  }
  if (test::IsShortRun()) return;
  const PoseSequence rotations = RotationsOf(trajectory);
  EXPECT_GE(rotations.size(), 0.95 * static_cast<double>(trajectory.frames.size()));
  const std::vector<PosePair> pairs =
      Associate(rotations, ReadTum(test::DataPath(folder + "/groundtruth.txt")), 15'000'000);
  const double rmse_deg = RelativeErrorOverTime(pairs, 1'000'000'000).rotation_deg.rmse;
  ::testing::Test::RecordProperty("rotation_rmse_deg", std::to_string(rmse_deg));
  EXPECT_LE(rmse_deg, 2.2);
}

StreamOpener OpenFolder(const std::string& folder) {
  return ToStreamOpener([folder] {
    ImageSource source = OpenImages(test::DataPath(folder).string(), {}, {});
    const cv::Size size = source.First().image.size();
    source.Prepare({size, size, MaskSource()});
    return source;
  });
}

/// Estimates the focal length from the images of a folder alone.
FocalSearchResult SearchFolder(const std::string& folder) {
  return FindFocalLength({OpenFolder(folder)}, {}).value().search;
}

/// The principal points and distortions of the real cameras differ from those that the search
/// assumes; this alone is an error of a seventh on KITTI.
TEST(RealFocalSearchTest, FocalLengthIsNearTheTrueOneIfTheCameraTurns) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  CORVO_REQUIRE_DATA("7scenes/redkitchen");
  const FocalSearchResult kitti = SearchFolder("kitti/sequences/05");
  EXPECT_TRUE(kitti.is_determined);
  EXPECT_NEAR(kitti.camera.fx / 707.1, 1, 0.15);
  const FocalSearchResult kitchen = SearchFolder("7scenes/redkitchen");
  EXPECT_TRUE(kitchen.is_determined);
  EXPECT_NEAR(kitchen.camera.fx / 525, 1, 0.06);
}

TEST(RealFocalSearchTest, AStraightRoadDoesNotDetermineTheFocalLength) {
  CORVO_REQUIRE_DATA("kitti/sequences/06");
  EXPECT_FALSE(SearchFolder("kitti/sequences/06").is_determined);
}

TEST(RealFindCameraTest, TheCameraIsAccurateWhereTheSearchIsNot) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  CORVO_REQUIRE_DATA("kitti/sequences/06");
  const CameraPrior turn = FindCamera(OpenFolder("kitti/sequences/05"), {}).value().prior;
  EXPECT_NEAR(turn.given.fx / 707.1, 1, 0.02);
  EXPECT_NEAR(turn.given.k1, 0.02, 0.01);
  const CameraPrior straight = FindCamera(OpenFolder("kitti/sequences/06"), {}).value().prior;
  EXPECT_NEAR(straight.given.fx / 707.1, 1, 0.08);
  EXPECT_EQ(straight.given.k1, 0);
  EXPECT_TRUE(straight.free.empty());
}

/// The last pass over images of an almost pure rotation, with an estimated camera and windows of 10
/// keyframes, poses fewer frames than the first.
TEST(RealFindCameraTest, ACameraWithWhichFewerImagesArePosedIsDropped) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("tum/rgbd_dataset_freiburg1_rpy");
  SelfCalibrationOptions options;
  options.odometry.bundle_adjuster.max_keyframes = 10;
  const CameraStart start =
      FindCamera(OpenFolder("tum/rgbd_dataset_freiburg1_rpy"), options).value();
  EXPECT_EQ(start.prior.given, start.search.camera);
  EXPECT_TRUE(start.prior.free.empty());
}

/// A rendered corridor, with its camera. For long stretches the image shows the joints of tiles
/// alone, along which matches may slide.
TEST(RealSequenceTest, TiledWallsKeepTheScaleFromAnyStart) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("recordings/rendered_tiles");
  const ImageList list = ListImages(test::DataPath("recordings/rendered_tiles/images"));
  const Camera camera =
      ReadCameraFile(test::DataPath("recordings/rendered_tiles/camera.yaml")).camera;
  const PoseSequence truth = ReadTum(test::DataPath("recordings/rendered_tiles/groundtruth.tum"));
  for (int start = 0; start <= 45; start += 15) {
    SCOPED_TRACE(start);
    const Trajectory trajectory = test::RunOdometry(
        [&](int i) {
          return test::TimedImage{ReadGrayImage(list.images[start + i].file),
                                  TimeNs{100'000'000} * (start + i)};
        },
        static_cast<int>(list.images.size()) - start, camera);
    EXPECT_EQ(trajectory.PosedShare(), 1);
    EXPECT_EQ(trajectory.Segments().size(), 1u);
    const Evaluation evaluation = test::EvaluatePosed(trajectory, truth);
    EXPECT_LT(evaluation.absolute.rmse, 0.01 * evaluation.truth_path_length);
  }
}

/// What people record: no calibration is known.
class RecordingTest : public ::testing::Test {
 protected:
  /// Runs over a recording with the camera that FindCamera() returns for it.
  void Run(const std::string& recording) {
    const StreamOpener open = OpenFolder(recording);
    Odometry odometry(FindCamera(open, {}).value().prior, OdometryOptions());
    const std::unique_ptr<ImageStream> stream = open();
    while (const std::optional<StreamImage> next = stream->Next()) {
      odometry.Process(next->image, next->time_ns);
    }
    odometry.Finish();
    focal_length_ = odometry.camera().fx();
    trajectory_ = odometry.GetTrajectory();
  }

  double focal_length_ = 0;
  Trajectory trajectory_;
};

/// Vehicles beside the camera keep their place in the image or recede.
TEST_F(RecordingTest, OfAMotorwayFromADashboardIsTracked) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("recordings/dashcam_motorway.mp4");
  Run("recordings/dashcam_motorway.mp4");
  EXPECT_EQ(trajectory_.PosedShare(), 1);
  EXPECT_EQ(trajectory_.Segments().size(), 1u);
  EXPECT_GT(focal_length_, 830);
  EXPECT_LT(focal_length_, 1100);
}

/// The reference is COLMAP's, with a focal length of 622 px.
TEST_F(RecordingTest, OfADarkRoomFromAPhoneIsTrackedAccurately) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("recordings/phone_monitor");
  Run("recordings/phone_monitor");
  EXPECT_EQ(trajectory_.PosedShare(), 1);
  EXPECT_NEAR(focal_length_ / 622, 1, 0.03);
  const PoseSequence reference = ReadTum(test::DataPath("recordings/phone_monitor/reference.tum"));
  const Evaluation evaluation = test::EvaluatePosed(trajectory_, reference);
  EXPECT_LT(evaluation.absolute.rmse, 0.004 * evaluation.truth_path_length);
}

TEST_F(RecordingTest, WithMotionBlurIsOneSegment) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("recordings/phone_close_blur");
  Run("recordings/phone_close_blur");
  EXPECT_GE(trajectory_.PosedShare(), 0.95);
  EXPECT_EQ(trajectory_.Segments().size(), 1u);
}

}  // namespace
}  // namespace corvo
