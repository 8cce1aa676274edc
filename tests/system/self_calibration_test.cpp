// SPDX-License-Identifier: MIT
// Runs the odometry with a wrong camera on rendered sequences whose camera is known exactly.
// Statistics over many of these runs: bench/calibration.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "tests/support/random.h"
#include "tests/system/sequence_runner.h"
#include "vo/odometry.h"

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

TEST(SelfCalibrationTest, PureRotationKeepsTheGivenCameraWithinItsSigmas) {
  const Sequence rotation = MakePureRotation(MakeOptions(test::IsShortRun() ? 12 : 60, 1));
  const CameraPrior prior{rotation.camera().parameters(), kFree};
  const Odometry odometry = RunOn(rotation, prior);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(std::abs(odometry.camera_estimate().difference[i]), kFree[i].sigma) << kFree[i].name;
  }
}

}  // namespace
}  // namespace corvo
