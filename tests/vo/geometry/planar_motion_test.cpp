// SPDX-License-Identifier: MIT
#include "vo/geometry/planar_motion.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// The plane n · x = d.
struct Plane {
  Eigen::Vector3d normal;
  double distance;
};

Eigen::Matrix3d HomographyOf(const SE3& second_from_first, const Plane& plane) {
  return second_from_first.rotation().matrix() +
         second_from_first.translation() * plane.normal.transpose() / plane.distance;
}

/// Returns rays that fill a field of view of 65 by 51 degrees, matched with the rays to which the
/// homography maps them.
std::vector<RayMatch> MatchesOf(const Eigen::Matrix3d& homography) {
  std::vector<RayMatch> matches;
  for (int y = -5; y <= 5; ++y) {
    for (int x = -5; x <= 5; ++x) {
      RayMatch match;
      match.first = {0.128 * x, 0.096 * y};
      match.second = (homography * match.first.homogeneous()).hnormalized();
      match.sigma = 0.002;
      matches.push_back(match);
    }
  }
  return matches;
}

std::vector<PlanarMotion> Decompose(const Eigen::Matrix3d& homography) {
  const std::vector<RayMatch> matches = MatchesOf(homography);
  return DecomposeHomography(homography, matches, std::vector<char>(matches.size(), 1));
}

/// Returns whether one of the motions is the true one, in units of the plane's distance.
bool HasTruth(const std::vector<PlanarMotion>& motions, const SE3& truth, const Plane& plane) {
  for (const PlanarMotion& motion : motions) {
    const Eigen::Vector3d t = truth.translation() / plane.distance;
    if ((motion.normal_in_first - plane.normal).norm() < 1e-6 &&
        (motion.second_from_first.translation() - t).norm() < 1e-6 &&
        (motion.second_from_first.rotation() * truth.rotation().Inverse()).Angle() < 1e-6) {
      return true;
    }
  }
  return false;
}

class DecomposeHomographyTest : public ::testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(DecomposeHomographyTest, TrueMotionIsFoundForAnyScaleAndSignOfTheHomography) {
  const SE3 truth(SO3::Exp({0.02, 0.1, -0.05}), GetParam());
  const Plane plane{Eigen::Vector3d(-0.3, 0.1, 1).normalized(), 4};
  const Eigen::Matrix3d homography = HomographyOf(truth, plane);
  for (const double factor : {1.0, 0.2, -1.0, -3.0}) {
    const std::vector<PlanarMotion> motions = Decompose(factor * homography);
    EXPECT_GE(motions.size(), 1u);
    EXPECT_LE(motions.size(), 2u);
    EXPECT_TRUE(HasTruth(motions, truth, plane)) << factor;
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, DecomposeHomographyTest,
                         ::testing::Values(Eigen::Vector3d(0.6, 0, 0), Eigen::Vector3d(0, -0.6, 0),
                                           Eigen::Vector3d(0.1, 0.1, 1.2),
                                           Eigen::Vector3d(0.4, -0.2, -0.5)));

/// Most matches are wrong, with rays that do not meet the plane in front of the first camera.
TEST(PlanarMotionTest, OnlyInliersHaveToMeetThePlaneInFrontOfTheCamera) {
  const SE3 truth(SO3::Exp({0.02, 0.1, -0.05}), {0.1, 0.1, 1.2});
  const Plane plane{Eigen::Vector3d(-0.3, 0.1, 1).normalized(), 4};
  const Eigen::Matrix3d homography = HomographyOf(truth, plane);
  std::vector<RayMatch> matches = MatchesOf(homography);
  std::vector<char> is_inlier(matches.size(), 1);
  const RayMatch wrong{{10, 0}, {0, 0}, 0.002};
  ASSERT_LT(plane.normal.dot(wrong.first.homogeneous()), 0);
  matches.resize(3 * matches.size(), wrong);
  is_inlier.resize(matches.size(), 0);
  EXPECT_TRUE(HasTruth(DecomposeHomography(homography, matches, is_inlier), truth, plane));
}

TEST(PlanarMotionTest, SidewaysMotionHasOneSolutionInFrontOfTheCameras) {
  const Plane wall{Eigen::Vector3d::UnitZ(), 3};
  EXPECT_EQ(Decompose(HomographyOf(SE3(SO3(), {0.5, 0, 0}), wall)).size(), 1u);
}

TEST(PlanarMotionTest, MotionAlongTheNormalHasOneSolution) {
  const Plane wall{Eigen::Vector3d::UnitZ(), 3};
  EXPECT_EQ(Decompose(HomographyOf(SE3(SO3(), {0, 0, 0.5}), wall)).size(), 1u);
}

TEST(PlanarMotionTest, PureRotationHasNoSolution) {
  const Plane wall{Eigen::Vector3d::UnitZ(), 3};
  EXPECT_TRUE(Decompose(HomographyOf(SE3(SO3::Exp({0, 0.1, 0}), {0, 0, 0}), wall)).empty());
}

constexpr double kMaxAngleDeg = 15;

TEST(PlaneHypothesesTest, TwinSolutionIsRejectedWhenTheMotionChangesDirection) {
  const Plane plane{Eigen::Vector3d(0.3, 0, 1).normalized(), 3};
  const SE3 first_step(SO3::Exp({0, 0.05, 0}), {0.1, 0, 0.6});
  const SE3 second_step(SO3::Exp({0, 0.05, 0.1}), {-0.3, 0.3, 0.8});
  const std::vector<PlanarMotion> first = Decompose(HomographyOf(first_step, plane));
  ASSERT_EQ(first.size(), 2u);
  PlaneHypotheses planes;
  EXPECT_TRUE(planes.Keep(0, first, kMaxAngleDeg).empty());
  EXPECT_EQ(planes.Keep(0, first, kMaxAngleDeg).size(), 2u);  // The same motions: still ambiguous.
  const std::vector<PlanarMotion> kept =
      planes.Keep(0, Decompose(HomographyOf(second_step, plane)), kMaxAngleDeg);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_TRUE(HasTruth(kept, second_step, plane));
}

TEST(PlaneHypothesesTest, ANewReferenceDiscardsEarlierHypotheses) {
  const Plane wall{Eigen::Vector3d::UnitZ(), 3};
  const std::vector<PlanarMotion> motions = Decompose(HomographyOf(SE3(SO3(), {0.5, 0, 0}), wall));
  PlaneHypotheses planes;
  planes.Keep(0, motions, kMaxAngleDeg);
  EXPECT_TRUE(planes.Keep(1, motions, kMaxAngleDeg).empty());
  EXPECT_EQ(planes.Keep(1, motions, kMaxAngleDeg).size(), 1u);
}

}  // namespace
}  // namespace corvo
