// SPDX-License-Identifier: MIT
#include "vo/camera/camera_prior.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

CameraPrior Prior(std::vector<FreeParameter> free) {
  return {test::PinholeCamera().parameters(), std::move(free)};
}

TEST(CameraPriorTest, ApplyChangesOnlyTheFreeParameters) {
  const CameraPrior prior = Prior({{"focal"}, {"cy"}, {"k1"}});
  const CameraParameters camera = prior.Apply(Eigen::Vector3d(std::log(1.1), -2, 0.05));
  CameraParameters expected = prior.given;
  expected.fx = expected.fy = 550;
  expected.cy = 237.5;
  expected.k1 = 0.05;
  EXPECT_NEAR(camera.fx, expected.fx, 1e-9);
  EXPECT_EQ(camera.fx, camera.fy);
  expected.fx = expected.fy = camera.fx;
  EXPECT_EQ(camera, expected);
}

TEST(CameraPriorTest, DifferenceIsTheInverseOfApply) {
  const CameraPrior prior = Prior({{"p2"}, {"fy"}, {"fx"}, {"k3"}, {"cx"}});
  Eigen::VectorXd difference(5);
  difference << 0.001, 3, -4, 0.2, 1.5;
  EXPECT_THAT(prior.Difference(prior.Apply(difference)), test::IsMatrixNear(difference, 1e-12));
  const CameraPrior focal = Prior({{"focal"}});
  EXPECT_NEAR(focal.Difference(focal.Apply(Eigen::VectorXd::Constant(1, 0.07)))[0], 0.07, 1e-12);
}

TEST(CameraPriorTest, ParametersWithoutASigmaHaveNoError) {
  const CameraPrior prior = Prior({{"focal", 0.01}, {"cx"}, {"k1", 0.02}});
  EXPECT_DOUBLE_EQ(prior.SquaredError(Eigen::Vector3d(0.02, 1e6, 0.02)), 4 + 0 + 1);
}

TEST(CameraPriorTest, ChiSquareTestAllowsAFewSigmas) {
  const CameraPrior prior = Prior({{"focal", 0.01}, {"k1", 0.02}, {"k2", 0.03}});
  EXPECT_THAT(Eigen::VectorXd(PriorEstimate(prior).covariance.diagonal()),
              test::IsMatrixNear(Eigen::VectorXd(Eigen::Vector3d(1e-4, 4e-4, 9e-4)), 1e-15));
  EXPECT_TRUE(prior.PassesChiSquareTest(Eigen::Vector3d(0.02, 0.04, -0.06)));
  EXPECT_FALSE(prior.PassesChiSquareTest(Eigen::Vector3d(0.05, 0, 0)));
  EXPECT_FALSE(prior.PassesChiSquareTest(Eigen::Vector3d(0, 0.06, 0.09)));
}

TEST(CameraPriorTest, ChiSquareTestIgnoresParametersWithoutASigma) {
  EXPECT_TRUE(Prior({{"cx"}}).PassesChiSquareTest(Eigen::VectorXd::Constant(1, 1e6)));
  EXPECT_FALSE(Prior({{"cx"}, {"k1", 0.1}}).PassesChiSquareTest(Eigen::Vector2d(0, 0.4)));
}

TEST(CameraPriorTest, ParametersThatKeepTheirValueDoNotCountInTheChiSquareTest) {
  // With one degree of freedom the limit of d / sigma is 3.29, with two 3.72.
  const CameraPrior prior = Prior({{"k1", 0.1}, {"p1", 1, true}});
  EXPECT_FALSE(prior.PassesChiSquareTest(Eigen::Vector2d(0.35, 0)));
  EXPECT_TRUE(prior.PassesChiSquareTest(Eigen::Vector2d(0.35, 1e-3)));
}

TEST(CameraPriorTest, DefaultPriorOfAPinholeCameraFreesFocalLengthAndRadialDistortion) {
  CalibrationOptions options;
  const CameraParameters given = test::PinholeCamera().parameters();
  EXPECT_EQ(MakePrior(given, options).free,
            (std::vector<FreeParameter>{{"focal", options.focal_sigma},
                                        {"k1", options.k1_sigma},
                                        {"k2", options.k2_sigma},
                                        {"cx", options.center_sigma_share * given.width, true},
                                        {"cy", options.center_sigma_share * given.width, true},
                                        {"p1", options.tangential_sigma, true},
                                        {"p2", options.tangential_sigma, true}}));
  EXPECT_THAT(MakePrior(given, options).IndicesWithoutEvidence(), testing::ElementsAre(0, 1, 2));
  options.center_sigma_share = options.tangential_sigma = 0;
  EXPECT_EQ(MakePrior(given, options).num_free(), 3);
}

TEST(CameraPriorTest, DefaultPriorOfAWideLensFreesFocalLengthAndDistortion) {
  const CalibrationOptions options;
  CameraParameters given = test::PinholeCamera().parameters();
  const double center_sigma = options.center_sigma_share * given.width;
  given.model = CameraModel::kKb4;
  EXPECT_EQ(MakePrior(given, options).free,
            (std::vector<FreeParameter>{{"focal", options.focal_sigma},
                                        {"k1", options.k1_sigma},
                                        {"k2", options.k2_sigma},
                                        {"cx", center_sigma, true},
                                        {"cy", center_sigma, true}}));
  given.model = CameraModel::kFov;
  given.omega = 0.9;
  const CameraPrior fov = MakePrior(given, options);
  ASSERT_EQ(fov.num_free(), 4);
  EXPECT_EQ(fov.free[0], (FreeParameter{"focal", options.focal_sigma}));
  EXPECT_EQ(fov.free[1].name, "omega");
  EXPECT_EQ(fov.free[2], (FreeParameter{"cx", center_sigma, true}));
  EXPECT_EQ(fov.free[3], (FreeParameter{"cy", center_sigma, true}));
}

TEST(CameraPriorTest, DefaultSigmaOfOmegaActsLikeThatOfK1) {
  const CalibrationOptions options;
  CameraParameters given = test::PinholeCamera().parameters();
  given.model = CameraModel::kFov;
  for (const double omega : {0.0, 0.2, 0.9}) {
    given.omega = omega;
    const double sigma = MakePrior(given, options).free[1].sigma;
    CameraParameters other = given;
    other.omega += sigma;
    const auto k1_of = [](const CameraParameters& lens) {
      const auto scale_at = [&](double r) {
        return (Camera(lens).Project({r, 0, 1})->x() - lens.cx) / (lens.fx * r);
      };
      const double on_axis = scale_at(1e-6);
      return (scale_at(0.01) / on_axis - 1) / (0.01 * 0.01);
    };
    EXPECT_NEAR(k1_of(given) - k1_of(other), options.k1_sigma, 0.01 * options.k1_sigma) << omega;
  }
}

TEST(CameraPriorTest, InflatedPriorHasLessWeight) {
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"focal", 0.01}, {"k1", 0.02}}};
  const CameraPrior beside = prior.Inflated(4);
  EXPECT_EQ(beside.given, prior.given);
  EXPECT_THAT(beside.free,
              testing::ElementsAre(FreeParameter{"focal", 0.02}, FreeParameter{"k1", 0.04}));
  const Eigen::Vector2d difference(0.003, 0.01);
  EXPECT_DOUBLE_EQ(4 * beside.SquaredError(difference), prior.SquaredError(difference));
}

TEST(CameraPriorTest, SigmasInPixelsAreResizedWithTheImages) {
  const CameraPrior prior = Prior({{"focal", 0.01}, {"cx", 2}, {"cy", 3}, {"k1", 0.1}});
  const CameraParameters& given = prior.given;
  const CameraPrior resized = prior.Resized(given.width / 2, given.height / 4);
  EXPECT_EQ(resized.given, Camera(given).Resized(given.width / 2, given.height / 4).parameters());
  EXPECT_EQ(resized.free,
            (std::vector<FreeParameter>{{"focal", 0.01}, {"cx", 1}, {"cy", 0.75}, {"k1", 0.1}}));
}

TEST(CameraPriorTest, PosteriorHasTheSigmasOfItsCovariance) {
  const CameraPrior prior = Prior({{"focal", 0.01}, {"k1", 0.2}});
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.005 * 0.005, 0.1 * 0.1).asDiagonal();
  EXPECT_EQ(Posterior(prior.free, covariance),
            (std::vector<FreeParameter>{{"focal", 0.005}, {"k1", 0.1}}));
  EXPECT_DOUBLE_EQ(InformationGain(prior.free[0], 0.005), 0.75);
  EXPECT_EQ(InformationGain({"cx"}, 3), 1) << "the prior has no sigma";
  EXPECT_EQ(InformationGain(prior.free[0], 0.02), 0) << "parts of the sequence disagree";
}

TEST(CameraPriorTest, ValueOfFocalIsFx) {
  CameraParameters camera = test::PinholeCamera().parameters();
  camera.fy = 510;
  EXPECT_EQ(ValueOf(camera, "focal"), camera.fx);
  EXPECT_EQ(ValueOf(camera, "fy"), 510);
}

TEST(CameraPriorTest, FreeParameterNamesAreThoseOfTheModel) {
  EXPECT_THAT(FreeParameterNames(CameraModel::kFov),
              testing::ElementsAre("focal", "fx", "fy", "cx", "cy", "omega"));
}

TEST(CameraPriorTest, ValidateRejectsInvalidFreeParameters) {
  const auto validate = [](const std::vector<FreeParameter>& free) {
    return [free] { Prior(free).Validate(); };
  };
  Prior({{"focal", 0.1}, {"cx"}, {"k1", 0.1}}).Validate();
  EXPECT_THAT(validate({{"omega"}}), test::ThrowsError("pinhole-radtan", "omega"));
  EXPECT_THAT(validate({{"width"}}), test::ThrowsError("no parameter", "width"));
  EXPECT_THAT(validate({{"k1", 0}}), test::ThrowsError("sigma of k1", "more than 0"));
  EXPECT_THAT(validate({{"focal"}, {"fy"}}), test::ThrowsError("fy", "twice"));
}

}  // namespace
}  // namespace corvo
