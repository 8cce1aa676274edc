// SPDX-License-Identifier: MIT
#include "apps/output/candidate_report.h"

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Returns a candidate with a converged adjustment and these standard deviations of its parameters.
CameraCandidate Known(CalibrationModel model, const std::vector<double>& sigma) {
  CameraCandidate candidate;
  candidate.model = model;
  candidate.prior = PriorOf(model, test::PinholeCamera());
  candidate.adjustment.status = AdjustmentStatus::kConverged;
  candidate.adjustment.camera = candidate.prior.given;
  candidate.adjustment.final_cost = 1234.5;
  const Eigen::VectorXd variances =
      Eigen::Map<const Eigen::VectorXd>(sigma.data(), static_cast<int>(sigma.size())).cwiseAbs2();
  candidate.adjustment.estimate.covariance = variances.asDiagonal();
  return candidate;
}

TEST(CandidateReportTest, WellDeterminedParametersCauseNoWarning) {
  EXPECT_THAT(UndeterminedWarnings(Known(CalibrationModel::kPinhole, {0.005, 1, 1})), IsEmpty());
}

TEST(CandidateReportTest, WarnsOfUndeterminedParametersWithAdvice) {
  EXPECT_THAT(UndeterminedWarnings(Known(CalibrationModel::kPinhole, {0.05, 1, 1})),
              ElementsAre(HasSubstr("focal length (standard deviation 5.0%): turn while ")));
  EXPECT_THAT(UndeterminedWarnings(Known(CalibrationModel::kPinhole, {0.005, 12, 1})),
              ElementsAre(HasSubstr("principal point")));
  EXPECT_THAT(UndeterminedWarnings(Known(CalibrationModel::kFov, {0.005, 1, 1, 0.9})),
              ElementsAre(HasSubstr("distortion")));
}

TEST(CandidateReportTest, PrintsValuesSigmasAndCorrelations) {
  CameraCandidate candidate = Known(CalibrationModel::kPinhole, {0.01, 2, 4});
  candidate.adjustment.estimate.covariance(2, 1) = candidate.adjustment.estimate.covariance(1, 2) =
      -4;
  const std::string text = EstimateText(candidate);
  EXPECT_THAT(text, HasSubstr("focal              500            5"));
  EXPECT_THAT(text, HasSubstr(" focal +0.00 cx -0.50\n"));
  EXPECT_EQ(EstimatedSigmas(candidate)[1], (FreeParameter{"cx", 2}));
}

TEST(CandidateReportTest, MarksTheSelectedModel) {
  std::vector<CameraCandidate> candidates{Known(CalibrationModel::kPinhole, {0.01, 2, 4}),
                                          Known(CalibrationModel::kFov, {0.01, 2, 4, 0.1})};
  candidates[1].adjustment.status = AdjustmentStatus::kSolverFailed;
  const std::string text = CandidatesText(candidates, 0);
  EXPECT_THAT(text, HasSubstr("\n* pinhole           3 "));
  EXPECT_THAT(text, HasSubstr(" 1234.5 "));
  EXPECT_THAT(text, HasSubstr("\n  fov               4 not estimated\n"));
}

}  // namespace
}  // namespace corvo
