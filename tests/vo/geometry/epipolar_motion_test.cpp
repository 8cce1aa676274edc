// SPDX-License-Identifier: MIT
#include "vo/geometry/epipolar_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/point_scene.h"
#include "vo/lie/se3.h"

namespace corvo {
namespace {

constexpr double kRaySigma = 1.0 / 500;

/// Returns exact matches of a scene's points in two views.
std::vector<RayMatch> MatchViews(const SE3& second_from_first) {
  test::Random random(1);
  std::vector<RayMatch> matches;
  for (const Eigen::Vector3d& in_first : test::MakeBoxScene(300, 3, 12, random).in_world) {
    const Eigen::Vector3d in_second = second_from_first * in_first;
    matches.push_back({in_first.hnormalized(), in_second.hnormalized(), kRaySigma});
  }
  return matches;
}

TEST(EpipolarMotionTest, MatchesOutweighAnUncertainRotation) {
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), {0.8, 0.1, 0.2});
  const Eigen::Vector3d apart(0.01, 0, 0);
  const EpipolarMotion start{SO3::Exp(apart) * truth.rotation(), truth.translation().normalized()};
  constexpr double kRotationSigma = 0.005;
  const Minimum<EpipolarMotion> fit = FitEpipolarMotion(MatchViews(truth), start, kRotationSigma);
  const SO3 error = fit.state.second_from_first * truth.rotation().Inverse();
  EXPECT_LT(error.Log().norm(), 0.001);
  EXPECT_LT(fit.state.baseline.cross(truth.translation().normalized()).norm(), 0.01);
  // The matches are exact: what remains is the rotation's distance from its measurement.
  EXPECT_NEAR(fit.cost, std::pow(apart.norm() / kRotationSigma, 2), 0.4);
}

TEST(EpipolarMotionTest, TwiceTheInformationHalvesHowFarMatchesTurnAnAlmostCertainRotation) {
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), {0.8, 0.1, 0.2});
  const EpipolarMotion start{SO3::Exp({0, 0, 5e-4}) * truth.rotation(),
                             truth.translation().normalized()};
  const auto turn = [&](double information) {
    const auto fit = FitEpipolarMotion(MatchViews(truth), start, 1 / std::sqrt(information));
    return (fit.state.second_from_first * start.second_from_first.Inverse()).Log().z();
  };
  const double once = turn(1e10), twice = turn(2e10);
  EXPECT_LT(once, 0) << "toward the truth";
  EXPECT_NEAR(twice / once, 0.5, 0.01);
}

TEST(EpipolarMotionTest, ACertainRotationIsKept) {
  const SE3 truth(SO3(), {0.8, 0.1, 0.2});
  const EpipolarMotion start{SO3::Exp({0.01, 0, 0}), truth.translation().normalized()};
  const Minimum<EpipolarMotion> fit = FitEpipolarMotion(MatchViews(truth), start, 1e-7);
  const SO3 change = fit.state.second_from_first * start.second_from_first.Inverse();
  EXPECT_LT(change.Log().norm(), 1e-5);
}

}  // namespace
}  // namespace corvo
