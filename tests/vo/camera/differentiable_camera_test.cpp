// SPDX-License-Identifier: MIT
#include "vo/camera/differentiable_camera.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

const Eigen::Vector3d kPoint(0.6, -0.4, 2);

/// Returns the derivative with respect to focal, k1 and k2 of the projection `pixel` of a point
/// with normalized coordinates (x/z, y/z).
Eigen::Matrix<double, 2, 3> AnalyticDerivative(const CameraParameters& camera,
                                               const Eigen::Vector2d& normalized,
                                               const Eigen::Vector2d& pixel) {
  const double s = normalized.squaredNorm();
  const Eigen::Vector2d radial(camera.fx * normalized.x(), camera.fy * normalized.y());
  Eigen::Matrix<double, 2, 3> derivative;
  derivative << pixel - Eigen::Vector2d(camera.cx, camera.cy), s * radial, s * s * radial;
  return derivative;
}

TEST(DifferentiableCameraTest, DerivativeMatchesTheAnalyticOne) {
  CameraParameters given = test::PinholeCamera().parameters();
  given.k1 = -0.1;
  given.k2 = 0.05;
  const CameraPrior prior{given, {{"focal"}, {"k1"}, {"k2"}}};
  const DifferentiableCamera camera(prior, Eigen::Vector3d(0.01, 0.02, 0));
  const Eigen::Vector2d pixel = *camera.camera().Project(kPoint);
  EXPECT_THAT(
      Eigen::MatrixXd(camera.PixelByDifference(kPoint, pixel)),
      test::IsMatrixNear(
          AnalyticDerivative(camera.camera().parameters(), kPoint.hnormalized(), pixel), 1e-5));
}

TEST(DifferentiableCameraTest, EveryDerivativeMatchesTheNumericOne) {
  CameraParameters given = test::PinholeCamera().parameters();
  given.k1 = -0.1;
  given.p2 = 0.01;
  for (const CameraModel model : {CameraModel::kPinhole, CameraModel::kKb4, CameraModel::kFov}) {
    given.model = model;
    if (model == CameraModel::kKb4) given.p2 = 0;
    if (model == CameraModel::kFov) given.k1 = 0, given.omega = 0.9;
    CameraPrior prior{given, {}};
    for (const std::string& name : FreeParameterNames(model)) {
      prior.free = {{name}};
      const auto pixel_at = [&](const Eigen::Matrix<double, 1, 1>& difference) {
        return *Camera(prior.Apply(difference)).Project(kPoint);
      };
      const Eigen::Matrix<double, 1, 1> none = Eigen::Matrix<double, 1, 1>::Zero();
      const DifferentiableCamera camera(prior, none);
      EXPECT_THAT(
          Eigen::MatrixXd(camera.PixelByDifference(kPoint, pixel_at(none))),
          test::IsMatrixNear(Eigen::MatrixXd(test::NumericJacobianAt<2, 1>(none, pixel_at)), 1e-3))
          << name;
    }
  }
}

TEST(DifferentiableCameraTest, PrincipalPointShiftsTheImageAndFyScalesOneAxis) {
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"cx"}, {"cy"}, {"fy"}}};
  const DifferentiableCamera camera(prior, Eigen::Vector3d::Zero());
  Eigen::Matrix<double, 2, 3> expected;
  expected << 1, 0, 0, 0, 1, -0.2;
  EXPECT_THAT(Eigen::MatrixXd(camera.PixelByDifference(kPoint, *camera.camera().Project(kPoint))),
              test::IsMatrixNear(expected, 1e-7));
}

TEST(DifferentiableCameraTest, WithoutDistortionOmegaHasNoEffectInFirstOrder) {
  CameraParameters given = test::PinholeCamera().parameters();
  given.model = CameraModel::kFov;
  const CameraPrior prior{given, {{"omega"}}};
  const auto derivative = [&](double omega, const Eigen::Vector3d& point) {
    const DifferentiableCamera camera(prior, Eigen::VectorXd::Constant(1, omega));
    return Eigen::MatrixXd(camera.PixelByDifference(point, *camera.camera().Project(point)));
  };
  EXPECT_THAT(derivative(0, kPoint), test::IsMatrixNear(Eigen::Vector2d(0, 0), 0));
  EXPECT_THAT(derivative(1e-6, kPoint), test::IsMatrixNear(Eigen::Vector2d(0, 0), 1e-3));
  EXPECT_THAT(derivative(0.9, {0, 0, 1}), test::IsMatrixNear(Eigen::Vector2d(0, 0), 0));
}

TEST(DifferentiableCameraTest, RejectsADifferenceThatGivesAnInvalidCamera) {
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"fx"}}};
  EXPECT_THAT([&] { DifferentiableCamera(prior, Eigen::VectorXd::Constant(1, -600)); },
              test::ThrowsError("camera.fx", "-100"));
}

}  // namespace
}  // namespace corvo
