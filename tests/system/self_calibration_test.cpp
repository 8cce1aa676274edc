// SPDX-License-Identifier: MIT
// Runs the odometry with a wrong camera on rendered sequences whose camera is known exactly.
// Statistics over many of these runs: bench/calibration.
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "tests/support/random.h"
#include "tests/system/recording.h"
#include "vo/odometry.h"
#include "vo/offline/calibration_check.h"
#include "vo/offline/match_residuals.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

using synthetic::Sequence;
using synthetic::SequenceOptions;

const std::vector<FreeParameter> kFree = {{"focal", 0.01}, {"k1", 0.03}, {"k2", 0.02}};

Odometry RunOn(const Sequence& sequence, const CameraPrior& prior) {
  Odometry odometry(prior);
  for (int i = 0; i < sequence.size(); ++i) {
    odometry.Process(sequence.Render(i), sequence.poses()[i].time_ns);
  }
  odometry.Finish();
  return odometry;
}

SequenceOptions MakeOptions(int frames, std::uint64_t noise_seed) {
  SequenceOptions options;
  options.frames = frames;
  options.width = 640;
  options.noise_sigma = 3;
  options.noise_seed = noise_seed;
  return options;
}

TEST(SelfCalibrationTest, AWrongCameraIsCorrectedToWithinTheReportedSigmas) {
  if (test::IsShortRun()) GTEST_SKIP() << "a short run ends before the camera is estimated";
  test::Random random(3);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Sequence room = MakeRoom(MakeOptions(150, seed));
    const CameraPrior truth{room.camera().parameters(), kFree};
    Eigen::VectorXd draw(3);
    for (int i = 0; i < 3; ++i) draw[i] = random.Gaussian(kFree[i].sigma);
    const Odometry odometry = RunOn(room, {truth.Apply(-draw), kFree});
    EXPECT_FALSE(odometry.prior_rejected()) << seed;
    const CameraEstimate& estimate = odometry.camera_estimate();
    for (int i = 0; i < 3; ++i) {
      const double sigma = std::sqrt(estimate.covariance(i, i));
      EXPECT_LE(std::abs(estimate.difference[i] - draw[i]), 3 * sigma)
          << kFree[i].name << ", " << seed;
    }
    EXPECT_LE(std::sqrt(estimate.covariance(1, 1)), 0.5 * kFree[1].sigma) << seed;
  }
}

/// Returns a camera of 480x360 px with a field of view of more than 110 degrees.
CameraParameters WideLens(CameraModel model) {
  CameraParameters lens;
  lens.model = model;
  lens.width = 480;
  lens.height = 360;
  lens.fx = lens.fy = 240;
  lens.cx = 239.5;
  lens.cy = 179.5;
  if (model == CameraModel::kFov) lens.omega = 0.9;
  return lens;
}

/// Expects that the odometry estimates focal length and distortion of a film's wide lens to within
/// three standard deviations, and the distortion with at most half of that of the prior, and that
/// it keeps the principal point.
void ExpectEstimated(const Sequence& film, const CameraParameters& given) {
  CalibrationOptions options;
  options.focal_sigma = 0.01;
  const CameraPrior prior = MakePrior(given, options);
  const Odometry odometry = RunOn(film, prior);
  EXPECT_FALSE(odometry.prior_rejected());
  const CameraEstimate& estimate = odometry.camera_estimate();
  const Eigen::VectorXd error = estimate.difference - prior.Difference(film.camera().parameters());
  const Eigen::VectorXd sigma = estimate.covariance.diagonal().cwiseSqrt();
  for (const int i : prior.IndicesWithoutEvidence()) {
    EXPECT_LE(std::abs(error[i]), 3 * sigma[i]) << prior.free[i].name;
    if (prior.free[i].name == "focal") continue;
    EXPECT_LE(sigma[i], 0.5 * prior.free[i].sigma) << prior.free[i].name;
  }
  EXPECT_EQ(odometry.camera().cx(), given.cx);
  EXPECT_EQ(odometry.camera().cy(), given.cy);
}

TEST(SelfCalibrationTest, AWideLensIsEstimatedWhetherTheGivenOneIsRightOrWrong) {
  CORVO_SKIP_IF_SHORT();
  for (const CameraModel model : {CameraModel::kKb4, CameraModel::kFov}) {
    SCOPED_TRACE(ToString(model));
    SequenceOptions options = MakeOptions(100, 1);
    options.camera = WideLens(model);
    const Sequence room = MakeRoom(options);
    ExpectEstimated(room, *options.camera);
    CameraParameters wrong = *options.camera;
    wrong.fx *= 1.01;
    wrong.fy *= 1.01;
    (model == CameraModel::kFov ? wrong.omega : wrong.k1) += 0.02;
    ExpectEstimated(room, wrong);
  }
}

TEST(SelfCalibrationTest, PureRotationKeepsTheGivenCameraWithinItsSigmas) {
  const Sequence rotation = MakePureRotation(MakeOptions(test::IsShortRun() ? 12 : 60, 1));
  const CameraPrior prior{rotation.camera().parameters(), kFree};
  const Odometry odometry = RunOn(rotation, prior);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(std::abs(odometry.camera_estimate().difference[i]), kFree[i].sigma) << kFree[i].name;
  }
}

CameraPrior FindCameraOf(const Sequence& sequence) {
  const test::Recording recording = test::Render(sequence);
  return FindCamera([&] { return std::make_unique<test::RecordedStream>(recording); }, {})
      .value()
      .prior;
}

/// Returns options for a camera of 480x360 px with this distortion.
SequenceOptions MakeLensOptions(int frames, double k1, double k2) {
  SequenceOptions options = MakeOptions(frames, 1);
  CameraParameters camera;
  camera.width = 480;
  camera.height = 360;
  camera.fx = camera.fy = 400;
  camera.cx = 239.5;
  camera.cy = 179.5;
  camera.k1 = k1;
  camera.k2 = k2;
  options.camera = camera;
  return options;
}

TEST(FindCameraTest, FindsAStrongDistortionWhereTheCameraTurns) {
  CORVO_SKIP_IF_SHORT();
  const CameraPrior prior = FindCameraOf(MakeRoom(MakeLensOptions(120, -0.3, 0.09)));
  EXPECT_NEAR(prior.given.fx, 400, 0.02 * 400);
  EXPECT_NEAR(prior.given.k1, -0.3, 0.05);
  EXPECT_EQ(prior.num_free(), 3);
}

/// A straight drive down a corridor, of which the images tell neither focal length nor distortion.
Sequence MakeStraightDrive(const SequenceOptions& options) {
  const Sequence corridor = MakeStreet(options);
  std::vector<SE3> poses;
  const SE3 start = corridor.scene_from_camera(0);
  for (int i = 0; i < options.frames; ++i) {
    poses.push_back(start * SE3(SO3(), Eigen::Vector3d(0, 0, 0.35 * i)));
  }
  return Sequence("drive", std::make_shared<synthetic::Scene>(corridor.scene()), corridor.camera(),
                  10, poses, options);
}

TEST(FindCameraTest, AStraightDriveLeavesTheDistortionAtZeroAndFixesTheCamera) {
  CORVO_SKIP_IF_SHORT();
  const Sequence drive = MakeStraightDrive(MakeLensOptions(50, 0, 0));
  const CameraPrior prior = FindCameraOf(drive);
  EXPECT_NEAR(prior.given.k1, 0, 0.02);
  EXPECT_NEAR(prior.given.k2, 0, 0.02);
  const Odometry odometry = RunOn(drive, prior);
  for (const FrameResult& frame : odometry.GetTrajectory().frames) {
    EXPECT_TRUE(frame.world_from_camera) << frame.index;
  }
  EXPECT_FALSE(odometry.prior_rejected());
}

/// Replaces all textures of a scene by one that repeats.
Sequence WithTexture(const Sequence& sequence, const synthetic::Canvas& canvas) {
  synthetic::Scene scene = sequence.scene();
  const int texture = scene.AddTexture(canvas);
  for (synthetic::Quad& quad : scene.quads) quad.texture = texture;
  std::vector<SE3> poses;
  for (int i = 0; i < sequence.size(); ++i) poses.push_back(sequence.scene_from_camera(i));
  return Sequence(sequence.name(), std::make_shared<synthetic::Scene>(scene), sequence.camera(),
                  sequence.frame_rate_hz(), poses, sequence.options());
}

/// Expects that a run with a camera, taken as exact, ends with an implausible calibration or not.
void ExpectImplausible(bool expected, const Sequence& sequence, double focal_factor) {
  CameraParameters camera = sequence.camera().parameters();
  camera.fx *= focal_factor;
  camera.fy *= focal_factor;
  const Odometry odometry = RunOn(sequence, {camera, {}});
  const CalibrationCheck check = CheckCalibration(odometry.map());
  const auto residuals = MeasureResiduals(odometry.map());
  ASSERT_TRUE(residuals);
  EXPECT_EQ(check.is_implausible || IsImplausible(*residuals), expected)
      << focal_factor << ": " << check.num_agreeing << " of " << check.num_parts << " parts, "
      << check.focal_px << " px, residuals of " << residuals->least_part_px << " px";
}

TEST(ImplausibleCalibrationTest, IsThatOfAWrongCameraAndNotOfRepetitiveTexture) {
  CORVO_SKIP_IF_SHORT();
  SequenceOptions options = MakeOptions(100, 1);
  options.width = 480;
  const Sequence room = MakeRoom(options);
  for (const synthetic::Canvas& canvas : {synthetic::DrawBricks(1), synthetic::DrawTiles(1)}) {
    const Sequence repetitive = WithTexture(room, canvas);
    ExpectImplausible(false, repetitive, 1);
    ExpectImplausible(true, repetitive, 0.9);
    ExpectImplausible(true, repetitive, 1.1);
    ExpectImplausible(true, repetitive, 0.5);
  }
}

}  // namespace
}  // namespace corvo
