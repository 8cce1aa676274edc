// SPDX-License-Identifier: MIT
#include "vo/geometry/rotation_estimator.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kFocalLength = 500;

/// Returns matched rays of random points in two views, with uniform noise of up to `sigma_px` in x
/// and y; every `wrong_every`-th match is wrong (0: none).
std::vector<RayMatch> MatchViews(const SE3& first_from_second, double sigma_px, int wrong_every,
                                 std::uint64_t seed) {
  test::Random random(seed);
  std::vector<RayMatch> matches;
  for (const Eigen::Vector3d& in_first : test::MakeBoxScene(300, 3, 15, random).in_world) {
    const Eigen::Vector3d in_second = first_from_second.Inverse() * in_first;
    RayMatch match;
    match.first = in_first.hnormalized() + random.Vector<2>(sigma_px / kFocalLength);
    match.second = in_second.hnormalized() + random.Vector<2>(sigma_px / kFocalLength);
    match.sigma = 1 / kFocalLength;
    if (wrong_every > 0 && matches.size() % wrong_every == 0) match.second += random.Vector<2>(0.5);
    matches.push_back(match);
  }
  return matches;
}

TEST(RotationEstimatorTest, FindsTheRotationDespiteWrongMatches) {
  const SO3 first_from_second = SO3::Exp({0.1, -0.2, 0.3});
  const auto matches = MatchViews(SE3(first_from_second, {0, 0, 0}), 0.1, 3, 6);
  EXPECT_THAT(EstimateRotation(matches), test::IsRotationNear(first_from_second.Inverse(), 0.1));
}

TEST(RotationEstimatorTest, ParallaxIsTheAngleRemainingAfterTheRotation) {
  RayMatch match;
  match.first = {0, 0};
  match.second = {1, 0};
  const std::vector<double> left = ComputeParallax({match}, SO3::Exp({0, 0.25, 0}));
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NEAR(left[0], std::atan(1.0) - 0.25, 1e-12);
}

TEST(RotationEstimatorTest, RefinementKeepsAPureRotation) {
  const SO3 first_from_second = SO3::Exp({0.02, 0.15, -0.03});
  const auto matches = MatchViews(SE3(first_from_second, {0, 0, 0}), 0.3, 5, 7);
  EXPECT_THAT(RefineRotation(matches, EstimateRotation(matches)),
              test::IsRotationNear(first_from_second.Inverse(), 0.3));
}

// A hand-held camera rotates about the wrist, not about its own center.
TEST(RotationEstimatorTest, RefinementDoesNotMistakeTranslationForRotation) {
  const SO3 first_from_second = SO3::Exp({0, 0.3, 0});
  const Eigen::Vector3d wrist_in_camera(0, 0, -0.5);
  const SE3 truth(first_from_second, wrist_in_camera - first_from_second * wrist_in_camera);
  const auto matches = MatchViews(truth, 0.2, 5, 8);
  const SO3 coarse = EstimateRotation(matches);
  const auto error = [&](const SO3& second_from_first) {
    return (second_from_first * first_from_second).Angle();
  };
  EXPECT_GT(error(coarse), 0.01);
  EXPECT_LT(error(RefineRotation(matches, coarse)), 0.2 * error(coarse));
}

// In a narrow field of view at similar depths, a rotation and a sideways translation look alike.
TEST(RotationEstimatorTest, RefinementIsStableInANarrowFieldOfView) {
  const SO3 first_from_second = SO3::Exp({0.01, 0.1, 0});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<RayMatch> matches = MatchViews(SE3(first_from_second, {0, 0, 0}), 1, 0, seed);
    std::erase_if(matches, [](const RayMatch& match) { return match.first.norm() > 0.25; });
    ASSERT_GT(matches.size(), 20u);
    const SO3 refined = RefineRotation(matches, EstimateRotation(matches));
    EXPECT_THAT(refined, test::IsRotationNear(first_from_second.Inverse(), 0.7)) << seed;
  }
}

}  // namespace
}  // namespace corvo
