// SPDX-License-Identifier: MIT
#include "vo/optimization/reprojection_cost.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/point_scene.h"
#include "vo/lie/se3_manifold.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

Camera DistortedCamera() {
  CameraParameters parameters = test::PinholeCamera().parameters();
  parameters.k1 = -0.28;
  parameters.k2 = 0.07;
  parameters.p1 = 2e-4;
  parameters.p2 = 2e-5;
  return Camera(parameters);
}

/// A camera without free parameters, in the form that a least-squares problem uses.
class ExactCamera {
 public:
  explicit ExactCamera(const Camera& camera)
      : prior_{camera.parameters(), {}}, adjusted_(prior_, difference_) {
    adjusted_.PrepareForEvaluation(true, true);
  }
  ExactCamera(const ExactCamera&) = delete;

  const AdjustedCamera& operator*() const { return adjusted_; }

 private:
  CameraPrior prior_;
  Eigen::VectorXd difference_;
  AdjustedCamera adjusted_;
};

struct Evaluation {
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
};

Evaluation Evaluate(const ReprojectionCost& cost, const SE3& pose, const Eigen::Vector3d& point) {
  const SE3::Data data = pose.data();
  const double* parameters[] = {data.data(), point.data()};
  Evaluation evaluation;
  double* jacobians[] = {evaluation.by_pose.data(), evaluation.by_point.data()};
  EXPECT_TRUE(cost.Evaluate(parameters, evaluation.residual.data(), jacobians));
  return evaluation;
}

TEST(ReprojectionCostTest, ResidualMatchesAHandComputedValue) {
  const ExactCamera camera(test::PinholeCamera());
  const ReprojectionCost cost(*camera, {0, 0, {319.5 + 99, 239.5 - 50}, 2.0});
  const Evaluation evaluation = Evaluate(cost, SE3(), {1, -0.5, 5});
  EXPECT_THAT(evaluation.residual, test::IsMatrixNear(Eigen::Vector2d(0.5, 0), 1e-12));
}

TEST(ReprojectionCostTest, JacobiansMatchTheNumericDerivatives) {
  test::Random random(3);
  const ExactCamera camera(DistortedCamera());
  const ReprojectionCost cost(*camera, {0, 0, {300, 200}, 1.7});
  for (int i = 0; i < 50; ++i) {
    const SE3 pose = random.Pose(3, 5);
    const Eigen::Vector3d point =
        pose * Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), 4);
    const Evaluation evaluation = Evaluate(cost, pose, point);
    const auto by_tangent = test::NumericJacobianAt<2>(
        pose, [&](const SE3& moved) { return Evaluate(cost, moved, point).residual; });
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> pose_by_tangent;
    SE3Manifold().PlusJacobian(pose.data().data(), pose_by_tangent.data());
    EXPECT_THAT((evaluation.by_pose * pose_by_tangent).eval(),
                test::IsMatrixNear(by_tangent, 1e-5));
    const auto by_point = test::NumericJacobianAt<2, 3>(
        point, [&](const Eigen::Vector3d& moved) { return Evaluate(cost, pose, moved).residual; });
    EXPECT_THAT(evaluation.by_point.eval(), test::IsMatrixNear(by_point, 1e-5));
  }
}

TEST(ReprojectionCostTest, PointBehindTheCameraHasALargeErrorAndZeroDerivatives) {
  const ExactCamera camera(test::PinholeCamera());
  const ReprojectionCost cost(*camera, {0, 0, {0, 0}, 1.0});
  const Evaluation evaluation = Evaluate(cost, SE3(), {0, 0, -1});
  EXPECT_EQ(evaluation.residual, Eigen::Vector2d(kUnprojectableError, 0));
  EXPECT_TRUE(evaluation.by_pose.isZero());
  EXPECT_TRUE(evaluation.by_point.isZero());
}

TEST(ReprojectionCostTest, CameraJacobianMatchesTheNumericDerivative) {
  const CameraPrior prior{DistortedCamera().parameters(), {{"focal"}, {"cx"}, {"k1"}}};
  Eigen::VectorXd difference = Eigen::Vector3d(0.01, 2, -0.02);
  AdjustedCamera adjusted(prior, difference);
  const ReprojectionCost cost(adjusted, {0, 0, {300, 200}, 1.7});
  const SE3::Data pose = SE3().data();
  const Eigen::Vector3d point(0.8, -0.5, 4);
  const auto residual_at = [&](const Eigen::Vector3d& moved, double** jacobians) {
    difference = moved;
    adjusted.PrepareForEvaluation(true, true);
    const double* parameters[] = {pose.data(), point.data(), difference.data()};
    Eigen::Vector2d residual;
    EXPECT_TRUE(cost.Evaluate(parameters, residual.data(), jacobians));
    return residual;
  };
  const Eigen::Vector3d at(0.01, 2, -0.02);
  const auto expected = test::NumericJacobianAt<2, 3>(
      at, [&](const Eigen::Vector3d& moved) { return residual_at(moved, nullptr); });
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_camera;
  double* jacobians[] = {nullptr, nullptr, by_camera.data()};
  residual_at(at, jacobians);
  EXPECT_THAT(by_camera.eval(), test::IsMatrixNear(expected, 1e-5));
}

TEST(ReprojectionCostTest, EvaluationFailsIfTheCameraIsInvalid) {
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"focal"}}};
  Eigen::VectorXd difference = Eigen::VectorXd::Constant(1, 1000);
  AdjustedCamera adjusted(prior, difference);
  adjusted.PrepareForEvaluation(true, true);
  EXPECT_EQ(adjusted.camera(), nullptr);
  const ReprojectionCost cost(adjusted, {0, 0, {300, 200}, 1.7});
  const SE3::Data pose = SE3().data();
  const Eigen::Vector3d point(0, 0, 4);
  const double* parameters[] = {pose.data(), point.data(), difference.data()};
  double residual[2];
  EXPECT_FALSE(cost.Evaluate(parameters, residual, nullptr));
}

}  // namespace
}  // namespace corvo
