// SPDX-License-Identifier: MIT
// Compares the stated covariances of poses with their errors on rendered sequences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "vo/math/median.h"
#include "vo/odometry.h"

namespace corvo {
namespace {

using synthetic::Sequence;
using synthetic::SequenceOptions;

/// The errors ξ of the relative poses of frames, with their covariances.
struct PoseErrors {
  std::vector<SE3::Tangent> errors;
  std::vector<SE3::Matrix6> covariances;

  /// Returns the squared Mahalanobis distances, χ² with six degrees of freedom.
  std::vector<double> SquaredDistances() const {
    std::vector<double> distances;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      distances.push_back(errors[i].dot(covariances[i].ldlt().solve(errors[i])));
    }
    return distances;
  }

  /// Returns the root mean square of each component in units of its standard deviation.
  SE3::Tangent RmsInSigmas() const {
    SE3::Tangent sum = SE3::Tangent::Zero();
    for (std::size_t i = 0; i < errors.size(); ++i) {
      sum += errors[i].cwiseAbs2().cwiseQuotient(covariances[i].diagonal());
    }
    return (sum / static_cast<double>(errors.size())).cwiseSqrt();
  }
};

/// Returns the unit of the newest keyframes: the spread of their true positions over that of the
/// estimated ones.
double ScaleOfWindow(const Map& map, const Sequence& sequence, int first_frame) {
  constexpr int kWindow = 10;
  std::vector<KeyframeId> keyframes = map.ActiveKeyframes();
  if (keyframes.size() > kWindow) keyframes.erase(keyframes.begin(), keyframes.end() - kWindow);
  Eigen::Matrix3Xd estimated(3, keyframes.size()), truth(3, keyframes.size());
  for (Eigen::Index i = 0; i < estimated.cols(); ++i) {
    const Frame& frame = map.keyframe(keyframes[i]).frame;
    estimated.col(i) = frame.world_from_camera.translation();
    truth.col(i) = sequence.poses()[first_frame + frame.index].world_from_camera.translation();
  }
  estimated.colwise() -= estimated.rowwise().mean().eval();
  truth.colwise() -= truth.rowwise().mean().eval();
  return truth.norm() / estimated.norm();
}

/// Adds the errors of the frames of a run from a frame on, once the map has several keyframes.
void AddErrors(const Sequence& sequence, int first_frame, PoseErrors& errors) {
  constexpr int kWarmUp = 16;
  OdometryOptions options;
  options.calibration.enabled = false;
  Odometry odometry(sequence.camera(), options);
  for (int i = first_frame; i < sequence.size(); ++i) {
    const FrameResult result = odometry.Process(sequence.Render(i), sequence.poses()[i].time_ns);
    ASSERT_EQ(result.world_from_camera.has_value(), result.relative_pose.has_value()) << i;
    if (!result.relative_pose || result.is_keyframe || result.index < kWarmUp) continue;
    if (odometry.map().ActiveKeyframes().size() < 3) continue;
    const int reference = first_frame + result.relative_pose->reference;
    const SE3 truth = sequence.poses()[reference].world_from_camera.Inverse() *
                      sequence.poses()[i].world_from_camera;
    const double scale = ScaleOfWindow(odometry.map(), sequence, first_frame);
    const SE3 scaled(truth.rotation(), truth.translation() / scale);
    errors.errors.push_back((result.relative_pose->reference_from_camera.Inverse() * scaled).Log());
    errors.covariances.push_back(result.relative_pose->covariance);
  }
}

/// Returns the errors of runs through parts of a scene at several levels of noise.
PoseErrors CollectErrors(Sequence (*make)(const SequenceOptions&), int width) {
  const int num_frames = test::IsShortRun() ? 20 : 36;
  PoseErrors errors;
  for (int run = 0; run < (test::IsShortRun() ? 1 : 6); ++run) {
    SequenceOptions options;
    options.width = test::IsShortRun() ? width / 2 : width;
    options.noise_sigma = std::vector<double>{0, 3, 8}[run % 3];
    options.noise_seed = run + 1;
    const int first_frame = 40 * run;
    options.frames = first_frame + num_frames;
    AddErrors(make(options), first_frame, errors);
  }
  return errors;
}

void ExpectCalibrated(const PoseErrors& errors) {
  if (test::IsShortRun()) return;
  constexpr double kQuantile95 = 12.59;  // Of χ² with six degrees of freedom; its median is 5.35.
  std::vector<double> distances = errors.SquaredDistances();
  ASSERT_GT(distances.size(), 60);
  const auto num_inside =
      std::ranges::count_if(distances, [](double d) { return d <= kQuantile95; });
  const double coverage = static_cast<double>(num_inside) / static_cast<double>(distances.size());
  ::testing::Test::RecordProperty("coverage", std::to_string(coverage));
  EXPECT_GT(coverage, 0.84);
  const double median = Median(distances);
  ::testing::Test::RecordProperty("median", std::to_string(median));
  EXPECT_GT(median, 3.5);
  EXPECT_LT(median, 7);
  // The noise of the keypoints alone, without that of landmarks and keyframes, would be too small.
  const SE3::Tangent rms = errors.RmsInSigmas();
  EXPECT_GT(rms.minCoeff(), 0.6);
  EXPECT_LT(rms.maxCoeff(), 1.5);
}

TEST(PoseCovarianceTest, CoversTheErrorsInTheRoom) {
  ExpectCalibrated(CollectErrors(&synthetic::MakeRoom, 640));
}

TEST(PoseCovarianceTest, CoversTheErrorsInTheStreet) {
  ExpectCalibrated(CollectErrors(&synthetic::MakeStreet, 1241));
}

}  // namespace
}  // namespace corvo
