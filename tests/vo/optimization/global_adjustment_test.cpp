// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle_adjuster.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"

namespace corvo {
namespace {

using ::testing::Each;
using ::testing::Ge;
using ::testing::Gt;

constexpr double kImageNoisePx = 0.5;

CameraPrior Exact(const Camera& camera) { return {camera.parameters(), {}}; }

AdjustmentSummary Adjust(const CameraPrior& prior, const CameraParameters& start,
                         std::vector<Bundle>& bundles, const AdjustmentProgress& progress = {}) {
  return BundleAdjuster({.num_rounds = 2}).Adjust(prior, start, bundles, progress);
}

/// Disturbs poses and points, except what fixes the gauge: the oldest pose and the distance of the
/// last pose from it.
void Disturb(Bundle& bundle, double size, test::Random& random) {
  for (std::size_t i = 1; i + 1 < bundle.views.size(); ++i) {
    Bundle::View& view = bundle.views[i];
    const Eigen::Matrix<double, 6, 1> change = size * random.Vector<6>();
    view.local_from_camera = (view.Pose() * SE3::Exp(change)).data();
  }
  for (Bundle::Point& point : bundle.points) point.in_local *= 1 + size * random.Gaussian(0.2);
}

double PoseError(const Bundle& bundle, const Bundle& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    const SE3 error = truth.views[i].Pose().Inverse() * bundle.views[i].Pose();
    sum += error.translation().squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(bundle.views.size()));
}

void ExpectUnchanged(const Bundle& bundle, const Bundle& before) {
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    EXPECT_EQ(bundle.views[i].local_from_camera, before.views[i].local_from_camera);
  }
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    EXPECT_EQ(bundle.points[i].in_local, before.points[i].in_local);
  }
}

TEST(GlobalAdjustmentTest, LowersTheCostAndTheError) {
  test::Random random(1);
  const Camera camera = test::PinholeCamera();
  const Bundle truth = test::MakeObservedBundle(camera, 12, kImageNoisePx, random);
  std::vector<Bundle> bundles{truth};
  Disturb(bundles[0], 0.02, random);
  const double error_before = PoseError(bundles[0], truth);
  const AdjustmentSummary result = Adjust(Exact(camera), camera.parameters(), bundles);
  EXPECT_TRUE(result.is_usable()) << ToString(result.status);
  EXPECT_LT(result.final_cost, 0.2 * result.initial_cost);
  std::vector<Bundle> from_truth{truth};
  Adjust(Exact(camera), camera.parameters(), from_truth);
  EXPECT_LT(PoseError(bundles[0], truth), 1.05 * PoseError(from_truth[0], truth));
  EXPECT_LT(PoseError(bundles[0], truth), 0.5 * error_before);
  EXPECT_EQ(result.num_observations, static_cast<int>(truth.observations.size()));
  EXPECT_NEAR(result.num_inliers / static_cast<double>(result.num_observations), 0.97, 0.03);
  EXPECT_NEAR(result.inlier_rms_px, std::sqrt(2.0) * kImageNoisePx, 0.15);
  EXPECT_EQ(result.camera, camera.parameters());
}

TEST(GlobalAdjustmentTest, OutliersAreDetectedAndHardlyAffectThePoses) {
  test::Random random(2);
  const Camera camera = test::PinholeCamera();
  const Bundle truth = test::MakeObservedBundle(camera, 12, kImageNoisePx, random);
  std::vector<Bundle> bundles{truth};
  for (std::size_t i = 0; i < bundles[0].observations.size(); i += 20) {
    bundles[0].observations[i].pixel += 40 * random.Vector<2>();
  }
  Disturb(bundles[0], 0.01, random);
  ASSERT_TRUE(Adjust(Exact(camera), camera.parameters(), bundles).is_usable());
  std::vector<Bundle> clean{truth};
  Adjust(Exact(camera), camera.parameters(), clean);
  EXPECT_LT(PoseError(bundles[0], truth), 1.5 * PoseError(clean[0], truth));
  int num_gross = 0, num_kept = 0;
  for (std::size_t i = 0; i < bundles[0].observations.size(); i += 20) {
    const Bundle::Observation& observation = bundles[0].observations[i];
    const double moved_px = (observation.pixel - truth.observations[i].pixel).norm();
    if (moved_px <= 10 * kImageNoisePx) continue;
    ++num_gross;
    num_kept += observation.is_inlier;
  }
  EXPECT_GT(num_gross, 50);
  EXPECT_LT(num_kept, 0.03 * num_gross);  // Few views detect errors along an epipolar line.
}

/// The result of adjusting bundles of a camera from a given start, without prior sigmas of the free
/// parameters.
struct Recovery {
  AdjustmentSummary result;
  Eigen::VectorXd error;  ///< Error of the difference from the given camera.
};

Recovery Recover(const Camera& truth, const CameraParameters& given,
                 const std::vector<std::string>& free, int num_bundles, test::Random& random) {
  std::vector<Bundle> bundles;
  for (int i = 0; i < num_bundles; ++i) {
    bundles.push_back(test::MakeObservedBundle(truth, 12, kImageNoisePx, random));
  }
  CameraPrior prior{given, {}};
  for (const std::string& name : free) prior.free.push_back({name});
  Recovery recovery{Adjust(prior, given, bundles), {}};
  recovery.error = prior.Difference(recovery.result.camera) - prior.Difference(truth.parameters());
  return recovery;
}

void ExpectRecovered(const Recovery& recovery) {
  ASSERT_TRUE(recovery.result.is_usable()) << ToString(recovery.result.status);
  const Eigen::VectorXd sigmas = recovery.result.estimate.covariance.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < sigmas.size(); ++i) {
    EXPECT_LT(std::abs(recovery.error[i]), 4 * sigmas[i]) << i;
  }
}

TEST(GlobalAdjustmentTest, FindsAPinholeCameraWithoutPriorSigmas) {
  test::Random random(3);
  CameraParameters camera = test::PinholeCamera().parameters();
  const CameraParameters given = camera;
  camera.fx = 520;
  camera.fy = 515;
  camera.cx += 6;
  camera.k1 = -0.08;
  camera.k2 = 0.02;
  const std::vector<std::string> free = {"fx", "fy", "cx", "cy", "k1", "k2"};
  const Recovery once = Recover(Camera(camera), given, free, 1, random);
  const Recovery thrice = Recover(Camera(camera), given, free, 3, random);
  ExpectRecovered(once);
  ExpectRecovered(thrice);
  EXPECT_LT(std::abs(thrice.result.camera.fx - 520), 5);
  const Eigen::ArrayXd gain = once.result.estimate.covariance.diagonal().array() /
                              thrice.result.estimate.covariance.diagonal().array();
  EXPECT_THAT(std::vector<double>(gain.begin(), gain.end()), Each(Gt(1.8)));
}

TEST(GlobalAdjustmentTest, FindsWideCamerasByTheirOwnParameters) {
  test::Random random(4);
  CameraParameters kb4 = test::PinholeCamera().parameters();
  kb4.model = CameraModel::kKb4;
  CameraParameters fov = test::PinholeCamera().parameters();
  fov.model = CameraModel::kFov;
  fov.omega = 0.7;
  const CameraParameters given_kb4 = kb4, given_fov = fov;
  kb4.fx = kb4.fy = 490;
  kb4.k1 = 0.03;
  fov.fx = fov.fy = 510;
  fov.omega = 0.8;
  ExpectRecovered(Recover(Camera(kb4), given_kb4, {"focal", "k1"}, 2, random));
  ExpectRecovered(Recover(Camera(fov), given_fov, {"focal", "omega"}, 2, random));
}

TEST(GlobalAdjustmentTest, ATightPriorKeepsTheGivenCamera) {
  test::Random random(5);
  CameraParameters camera = test::PinholeCamera().parameters();
  camera.k1 = 0.05;
  std::vector<Bundle> bundles{test::MakeObservedBundle(Camera(camera), 12, kImageNoisePx, random)};
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"k1", 1e-7}}};
  const AdjustmentSummary result = Adjust(prior, prior.given, bundles);
  EXPECT_TRUE(result.is_usable()) << ToString(result.status);
  EXPECT_NEAR(result.camera.k1, 0, 1e-6);
}

TEST(GlobalAdjustmentTest, InformationFactorScalesTheWeightOfTheObservations) {
  constexpr double kFactor = 4;
  test::Random random(13);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 12, kImageNoisePx, random)},
      again = bundles;
  const CameraPrior prior{camera.parameters(), {{"focal", 0.01}, {"k1", 0.01}}};
  const AdjustmentSummary counted = BundleAdjuster({.num_rounds = 2, .information_factor = kFactor})
                                        .Adjust(prior, prior.given, bundles);
  const AdjustmentSummary once = Adjust(prior.Inflated(kFactor), prior.given, again);
  EXPECT_EQ(counted.camera, once.camera);
  EXPECT_EQ(counted.final_cost, once.final_cost);
  EXPECT_THAT(Eigen::MatrixXd(kFactor * counted.estimate.covariance),
              test::IsMatrixNear(once.estimate.covariance, 1e-15));
}

TEST(GlobalAdjustmentTest, APerfectSolutionIsUnchanged) {
  test::Random random(6);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 8, 0, random)};
  for (Bundle::Observation& observation : bundles[0].observations) {
    const Bundle::Point& point = bundles[0].points[observation.point];
    observation.pixel =
        *camera.Project(bundles[0].views[observation.view].Pose().Inverse() * point.in_local);
  }
  const std::vector<Bundle> before = bundles;
  const AdjustmentSummary result = Adjust(Exact(camera), camera.parameters(), bundles);
  EXPECT_TRUE(result.is_usable()) << ToString(result.status);
  EXPECT_NEAR(result.final_cost, 0, 1e-15);
  EXPECT_LT(PoseError(bundles[0], before[0]), 1e-9);
}

TEST(GlobalAdjustmentTest, SolutionOfHigherCostIsRejected) {
  test::Random random(14);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 8, kImageNoisePx, random)};
  Adjust(Exact(camera), camera.parameters(), bundles);
  const Bundle before = bundles[0];
  // The second round fits the few observations that the first one leaves within 0.1 sigma.
  const AdjustmentSummary result = BundleAdjuster({.num_rounds = 2, .max_error_sigmas = 0.1})
                                       .Adjust(Exact(camera), camera.parameters(), bundles);
  EXPECT_EQ(result.status, AdjustmentStatus::kNotImproved) << ToString(result.status);
  EXPECT_GT(result.final_cost, result.initial_cost);
  ExpectUnchanged(bundles[0], before);
}

TEST(GlobalAdjustmentTest, BundlesAreUnchangedIfAnObservationIsNotFinite) {
  test::Random random(7);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 8, kImageNoisePx, random)};
  Disturb(bundles[0], 0.02, random);
  bundles[0].observations[5].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Bundle> before = bundles;
  const AdjustmentSummary result = Adjust(Exact(camera), camera.parameters(), bundles);
  EXPECT_EQ(result.status, AdjustmentStatus::kSolverFailed);
  ExpectUnchanged(bundles[0], before[0]);
  std::vector<Bundle> nothing;
  EXPECT_EQ(Adjust(Exact(camera), camera.parameters(), nothing).status,
            AdjustmentStatus::kNoObservations);
}

TEST(GlobalAdjustmentTest, APointBehindACameraIsAnOutlierAndDoesNotStopTheAdjustment) {
  test::Random random(8);
  const Camera camera = test::PinholeCamera();
  const Bundle truth = test::MakeObservedBundle(camera, 12, kImageNoisePx, random);
  std::vector<Bundle> bundles{truth};
  Disturb(bundles[0], 0.02, random);
  bundles[0].points[3].in_local *= -1;
  EXPECT_TRUE(Adjust(Exact(camera), camera.parameters(), bundles).is_usable());
  EXPECT_LT(PoseError(bundles[0], truth), 0.02);
  for (const Bundle::Observation& observation : bundles[0].observations) {
    EXPECT_FALSE(observation.is_inlier && observation.point == 3);
  }
}

TEST(GlobalAdjustmentTest, ResultDoesNotDependOnMemoryAddresses) {
  const auto adjust = [] {
    test::Random random(9);
    std::vector<Bundle> bundles;
    for (int i = 0; i < 3; ++i) {
      bundles.push_back(test::MakeObservedBundle(test::PinholeCamera(), 8, kImageNoisePx, random));
    }
    const CameraPrior prior{test::PinholeCamera().parameters(), {{"focal", 0.01}, {"k1", 0.1}}};
    const AdjustmentSummary result = Adjust(prior, prior.given, bundles);
    return std::pair(result, bundles);
  };
  const auto first = adjust();
  const std::vector<Bundle> elsewhere(7, first.second[0]);
  const auto second = adjust();
  EXPECT_EQ(first.first.camera, second.first.camera);
  EXPECT_EQ(first.first.final_cost, second.first.final_cost);
  EXPECT_EQ(first.first.estimate.covariance, second.first.estimate.covariance);
  for (int i = 0; i < 3; ++i) ExpectUnchanged(first.second[i], second.second[i]);
}

TEST(GlobalAdjustmentTest, ManyViewsAreSolvedBySparseAlgebra) {
  CORVO_SKIP_IF_SHORT();
  test::Random random(10);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> truth, bundles;
  for (int i = 0; i < 28; ++i)
    truth.push_back(test::MakeObservedBundle(camera, 11, kImageNoisePx, random));
  bundles = truth;
  for (Bundle& bundle : bundles) Disturb(bundle, 0.02, random);
  const CameraPrior prior{camera.parameters(), {{"focal", 0.01}}};
  std::vector<Bundle> again = bundles;
  const AdjustmentSummary result = Adjust(prior, prior.given, bundles);
  EXPECT_TRUE(result.is_usable()) << ToString(result.status);
  EXPECT_EQ(Adjust(prior, prior.given, again).camera, result.camera);
  for (std::size_t i = 0; i < bundles.size(); ++i) {
    EXPECT_LT(PoseError(bundles[i], truth[i]), 0.02) << i;
    ExpectUnchanged(again[i], bundles[i]);
  }
}

TEST(GlobalAdjustmentTest, ProgressCallbackCancels) {
  test::Random random(12);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 8, kImageNoisePx, random)};
  Disturb(bundles[0], 0.02, random);
  const Bundle before = bundles[0];
  int num_calls = 0;
  const AdjustmentSummary result =
      Adjust(Exact(camera), camera.parameters(), bundles, [&](double) { return ++num_calls < 3; });
  EXPECT_EQ(num_calls, 3);
  EXPECT_EQ(result.status, AdjustmentStatus::kCanceled);
  ExpectUnchanged(bundles[0], before);
}

TEST(GlobalAdjustmentTest, ReportsItsProgress) {
  test::Random random(11);
  const Camera camera = test::PinholeCamera();
  std::vector<Bundle> bundles{test::MakeObservedBundle(camera, 6, kImageNoisePx, random)};
  Disturb(bundles[0], 0.02, random);
  std::vector<double> shares;
  Adjust(Exact(camera), camera.parameters(), bundles, [&](double share) {
    shares.push_back(share);
    return true;
  });
  ASSERT_GT(shares.size(), 3u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_THAT(shares, Each(Ge(0)));
  EXPECT_EQ(shares.back(), 1);
}

}  // namespace
}  // namespace corvo
