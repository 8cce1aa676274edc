#include "vo/camera_prior.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

CameraPrior MakePrior(std::vector<FreeParameter> free) {
  return {test::PinholeCamera().parameters(), std::move(free)};
}

TEST(CameraPriorTest, ADifferenceMovesWhatIsFree) {
  const CameraPrior prior = MakePrior({{"focal"}, {"cy"}, {"k1"}});
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
  const CameraPrior prior = MakePrior({{"p2"}, {"fy"}, {"fx"}, {"k3"}, {"cx"}});
  Eigen::VectorXd difference(5);
  difference << 0.001, 3, -4, 0.2, 1.5;
  EXPECT_THAT(prior.Difference(prior.Apply(difference)), test::IsMatrixNear(difference, 1e-12));
  const CameraPrior focal = MakePrior({{"focal"}});
  EXPECT_NEAR(focal.Difference(focal.Apply(Eigen::VectorXd::Constant(1, 0.07)))[0], 0.07, 1e-12);
}

TEST(CameraPriorTest, WhatIsNotKnownHasNoError) {
  const CameraPrior prior = MakePrior({{"focal", 0.01}, {"cx"}, {"k1", 0.02}});
  EXPECT_DOUBLE_EQ(prior.SquaredError(Eigen::Vector3d(0.02, 1e6, 0.02)), 4 + 0 + 1);
}

TEST(CameraPriorTest, RefusesWhatTheModelDoesNotHave) {
  const auto validate = [](std::vector<FreeParameter> free) {
    return [free] { MakePrior(free).Validate(); };
  };
  MakePrior({{"focal", 0.1}, {"cx"}, {"k1", 0.1}}).Validate();
  EXPECT_THAT(validate({{"omega"}}), test::ThrowsError("pinhole-radtan", "omega"));
  EXPECT_THAT(validate({{"width"}}), test::ThrowsError("no parameter", "width"));
  EXPECT_THAT(validate({{"k1", 0}}), test::ThrowsError("sigma of k1", "more than 0"));
  EXPECT_THAT(validate({{"focal"}, {"fy"}}), test::ThrowsError("fy", "twice"));
}

}  // namespace
}  // namespace corvo
