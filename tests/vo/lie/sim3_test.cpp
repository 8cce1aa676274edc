// SPDX-License-Identifier: MIT
#include "vo/lie/sim3.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/vo/lie/lie_elements.h"

namespace corvo {
namespace {

using test::IsMatrixNear;
using test::IsPoseNear;
using test::IsSimilarityNear;
using test::kPi;
using test::kTinyDeg;
using test::ThrowsError;

/// Returns AwkwardMotions() with scales from 1/50 to 50, including 1.
std::vector<Sim3::Tangent> AwkwardSimilarities() {
  const double sigmas[] = {0, 1e-12, -1e-6, 0.01, -0.3, 1, std::log(50), -std::log(50)};
  std::vector<Sim3::Tangent> tangents;
  for (const SE3::Tangent& motion : test::AwkwardMotions()) {
    const double sigma = sigmas[tangents.size() % 8];
    tangents.push_back((Sim3::Tangent() << motion, sigma).finished());
  }
  return tangents;
}

double Rounding(const Sim3::Tangent& tangent) {
  return 1e-13 * std::max(1.0, tangent.head<3>().norm()) * std::exp(std::abs(tangent(6)));
}

TEST(Sim3Test, DefaultIsIdentity) { EXPECT_EQ(Sim3().matrix(), Eigen::Matrix4d::Identity()); }

TEST(Sim3Test, RotatesScalesThenTranslates) {
  const Sim3 b_from_a(2, SO3::Exp(Eigen::Vector3d(0, 0, 0.5 * kPi)), Eigen::Vector3d(10, 20, 30));
  EXPECT_THAT(b_from_a * Eigen::Vector3d(1, 0, 0),
              IsMatrixNear(Eigen::Vector3d(10, 22, 30), 1e-14));
}

TEST(Sim3Test, ScaleOneIsRigid) {
  for (const SE3::Tangent& motion : test::AwkwardMotions()) {
    const Sim3 similarity = Sim3::Exp((Sim3::Tangent() << motion, 0).finished());
    const double rounding = 1e-14 * std::max(1.0, motion.head<3>().norm());
    EXPECT_THAT(similarity, IsSimilarityNear(Sim3(SE3::Exp(motion)), kTinyDeg, rounding, 0.0));
  }
}

TEST(Sim3Test, ExpIsTheMatrixExponential) {
  for (const Sim3::Tangent& tangent : AwkwardSimilarities()) {
    if (tangent.head<3>().norm() > 1e3) continue;  // Eigen's exp() loses digits here.
    Eigen::Matrix4d hat = Eigen::Matrix4d::Zero();
    hat.topLeftCorner<3, 3>() =
        SO3::Hat(tangent.segment<3>(3)) + tangent(6) * Eigen::Matrix3d::Identity();
    hat.topRightCorner<3, 1>() = tangent.head<3>();
    EXPECT_THAT(Sim3::Exp(tangent).matrix(), IsMatrixNear(hat.exp(), 10 * Rounding(tangent)))
        << tangent.transpose();
  }
}

TEST(Sim3Test, LogInvertsExp) {
  for (const Sim3::Tangent& tangent : AwkwardSimilarities()) {
    const Sim3 similarity = Sim3::Exp(tangent);
    EXPECT_THAT(Sim3::Exp(similarity.Log()),
                IsSimilarityNear(similarity, kTinyDeg, 10 * Rounding(tangent), 1e-14));
    if (tangent.segment<3>(3).norm() > kPi - 1e-11) continue;
    EXPECT_THAT(similarity.Log(), IsMatrixNear(tangent, 1e-11 + 1e3 * Rounding(tangent)));
  }
}

TEST(Sim3Test, GroupLawsHold) {
  const Eigen::Vector3d point(3, -1, 2);
  const Sim3 fixed = Sim3::Exp((Sim3::Tangent() << 1, 2, 3, 0.3, -2, 0.7, 0.4).finished());
  for (const Sim3::Tangent& tangent : AwkwardSimilarities()) {
    const Sim3 similarity = Sim3::Exp(tangent);
    const double rounding = 10 * Rounding(tangent);
    EXPECT_THAT(similarity * similarity.Inverse(),
                IsSimilarityNear(Sim3(), kTinyDeg, rounding, 1e-14));
    EXPECT_THAT(similarity.Inverse() * (similarity * point),
                IsMatrixNear(point, rounding * std::exp(std::abs(tangent(6)))));
    EXPECT_THAT((fixed * similarity) * point, IsMatrixNear(fixed * (similarity * point), rounding));
    EXPECT_THAT((fixed * similarity).matrix(),
                IsMatrixNear(fixed.matrix() * similarity.matrix(), rounding));
  }
}

TEST(Sim3Test, AdjointMovesAPerturbationToTheOtherSide) {
  const Sim3::Tangent delta = (Sim3::Tangent() << 0.4, -0.5, 0.6, 0.1, 0.2, -0.3, 0.25).finished();
  for (const Sim3::Tangent& tangent : AwkwardSimilarities()) {
    const Sim3 similarity = Sim3::Exp(tangent);
    const Sim3 moved = similarity * Sim3::Exp(delta) * similarity.Inverse();
    EXPECT_THAT(moved, IsSimilarityNear(Sim3::Exp(similarity.Adjoint() * delta), kTinyDeg,
                                        100 * Rounding(tangent), 1e-14));
  }
}

TEST(Sim3Test, TransformsPosesByTheirOriginAndAxes) {
  const Sim3 b_from_a(3, SO3::Exp(Eigen::Vector3d(0.1, 0.2, 0.3)), Eigen::Vector3d(1, 2, 3));
  const SE3 a_from_c(SO3::Exp(Eigen::Vector3d(-1, 0.5, 0)), Eigen::Vector3d(4, 5, -6));
  const SE3 b_from_c = TransformPose(b_from_a, a_from_c);
  EXPECT_THAT(b_from_c * Eigen::Vector3d::Zero(),
              IsMatrixNear(b_from_a * a_from_c.translation(), 1e-13));
  const Eigen::Vector3d point_in_c(0.5, -2, 1);
  EXPECT_THAT(b_from_c * (3 * point_in_c), IsMatrixNear(b_from_a * (a_from_c * point_in_c), 1e-13));
}

TEST(Sim3Test, RigidSimilarityTransformsPosesLikeSE3) {
  const SE3 rigid(SO3::Exp(Eigen::Vector3d(0.1, 0.2, 0.3)), Eigen::Vector3d(1, 2, 3));
  const SE3 pose(SO3::Exp(Eigen::Vector3d(-1, 0.5, 0)), Eigen::Vector3d(4, 5, -6));
  EXPECT_THAT(TransformPose(Sim3(rigid), pose), IsPoseNear(rigid * pose, kTinyDeg, 1e-14));
}

TEST(Sim3Test, RejectsScalesThatAreNotPositive) {
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { Sim3(scale, SO3(), Eigen::Vector3d::Zero()); }, ThrowsError("scale"));
  }
}

}  // namespace
}  // namespace corvo
