// SPDX-License-Identifier: MIT
#include "vo/offline/camera_selection.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"

namespace corvo {
namespace {

constexpr double kNoisePx = 0.5;

/// Returns a camera with the principal point in the center of the image, as the selection assumes.
CameraParameters Centered() {
  CameraParameters camera = test::PinholeCamera().parameters();
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

/// Adjusts candidates of all models to a simulated sequence of a camera, starting with a focal
/// length that is 4% too long.
std::vector<CameraCandidate> AdjustAll(const CameraParameters& truth) {
  test::Random random(1);
  const std::vector<Bundle> bundles{test::MakeObservedBundle(Camera(truth), 12, kNoisePx, random)};
  CameraParameters start = Centered();
  start.fx *= 1.04;
  start.fy *= 1.04;
  std::vector<CameraCandidate> candidates;
  for (const CalibrationModel model : AllCalibrationModels()) {
    candidates.push_back(AdjustCandidate(model, Camera(start), bundles));
  }
  return candidates;
}

TEST(CameraSelectionTest, WithoutDistortionThePinholeModelIsSelected) {
  const std::vector<CameraCandidate> candidates = AdjustAll(Centered());
  const int selected = SelectCandidate(candidates);
  ASSERT_NE(selected, kNoId);
  EXPECT_EQ(candidates[selected].model, CalibrationModel::kPinhole);
  EXPECT_NEAR(candidates[selected].adjustment.camera.fx, Centered().fx, 0.01 * Centered().fx);
}

TEST(CameraSelectionTest, WithDistortionTheRadtanModelIsSelected) {
  CameraParameters truth = Centered();
  truth.k1 = -0.15;
  truth.k2 = 0.05;
  truth.p1 = 0.003;
  const std::vector<CameraCandidate> candidates = AdjustAll(truth);
  const int selected = SelectCandidate(candidates);
  ASSERT_NE(selected, kNoId);
  EXPECT_EQ(candidates[selected].model, CalibrationModel::kRadtan);
  EXPECT_NEAR(candidates[selected].adjustment.camera.fx, truth.fx, 0.01 * truth.fx);
  EXPECT_NEAR(candidates[selected].adjustment.camera.k1, truth.k1, 0.02);
}

CameraCandidate Candidate(int num_free, double criterion) {
  CameraCandidate candidate;
  candidate.prior.free.resize(num_free);
  candidate.information_criterion = criterion;
  return candidate;
}

TEST(CameraSelectionTest, SelectsTheSimplestCandidateThatIsNotClearlyWorse) {
  EXPECT_EQ(SelectCandidate({Candidate(3, 109), Candidate(4, 100), Candidate(7, 100)}), 0);
  EXPECT_EQ(SelectCandidate({Candidate(3, 110), Candidate(7, 100)}), 0);
  EXPECT_EQ(SelectCandidate({Candidate(3, 111), Candidate(7, 100), Candidate(4, 105)}), 2);
  EXPECT_EQ(SelectCandidate({Candidate(3, 200), Candidate(7, 100)}), 1);
}

TEST(CameraSelectionTest, CandidatesOfFailedAdjustmentsAreNotSelected) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(SelectCandidate({Candidate(3, infinity), Candidate(7, 100)}), 1);
  EXPECT_EQ(SelectCandidate({Candidate(3, infinity)}), kNoId);
  EXPECT_EQ(SelectCandidate({}), kNoId);
  EXPECT_EQ(
      AdjustCandidate(CalibrationModel::kPinhole, test::PinholeCamera(), {}).information_criterion,
      infinity);
}

TEST(CameraSelectionTest, TheFocalLengthHasNoPriorSigma) {
  for (const CalibrationModel model : AllCalibrationModels()) {
    const CameraPrior prior = PriorOf(model, test::PinholeCamera());
    prior.Validate();
    EXPECT_EQ(prior.free.front(), FreeParameter{"focal"}) << ToString(model);
    EXPECT_EQ(prior.given.cx, 0.5 * (test::PinholeCamera().width() - 1));
  }
}

}  // namespace
}  // namespace corvo
