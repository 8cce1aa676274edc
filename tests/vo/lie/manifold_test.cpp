// SPDX-License-Identifier: MIT
#include <ceres/manifold_test_utils.h>
#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/vo/lie/lie_elements.h"
#include "vo/lie/se3_manifold.h"

namespace ceres {
namespace {

using corvo::SE3;
using corvo::SE3Manifold;

TEST(SE3ManifoldTest, HasAmbientSize7AndTangentSize6) {
  EXPECT_EQ(SE3Manifold().AmbientSize(), 7);
  EXPECT_EQ(SE3Manifold().TangentSize(), 6);
}

TEST(SE3ManifoldTest, CeresManifoldInvariantsHold) {
  const SE3Manifold manifold;
  corvo::test::Random random(3);
  for (const SE3::Tangent& motion : corvo::test::AwkwardMotions()) {
    // The matchers' tolerance is relative to |motion|; around π the inverse is not unique.
    if (motion.norm() < 1e-6 || motion.norm() > 1e3 || motion.tail<3>().norm() > 3.1) continue;
    const SE3 pose = random.Pose(3.1, 10);
    const Vector x = pose.data(), delta = motion;
    const Vector y = (pose * SE3::Exp(random.Vector<6>(1.5))).data();
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-8);
  }
}

TEST(SE3ManifoldTest, PlusPerturbsOnTheRight) {
  const SE3Manifold manifold;
  corvo::test::Random random(4);
  const SE3 pose = random.Pose(3, 5);
  const SE3::Tangent delta = random.Vector<6>(0.5);
  SE3::Data x = pose.data(), sum;
  ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), sum.data()));
  EXPECT_EQ(SE3::FromData(sum.data()), pose * SE3::Exp(delta));
}

TEST(SE3ManifoldTest, ToleratesAQuaternionOfNearlyUnitNorm) {
  const SE3Manifold manifold;
  corvo::test::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const SE3 pose = random.Pose(3, 5);
    SE3::Data x = pose.data(), sum;
    x.head<4>() *= 1 + random.Uniform(-1e-6, 1e-6);
    const SE3::Tangent delta = random.Vector<6>(0.5);
    SE3::Tangent difference;
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), sum.data()));
    ASSERT_TRUE(manifold.Minus(sum.data(), x.data(), difference.data()));
    EXPECT_NEAR(sum.head<4>().norm(), 1, 1e-15);
    EXPECT_THAT(difference, corvo::test::IsMatrixNear(delta, 1e-13));
  }
}

}  // namespace
}  // namespace ceres
