// SPDX-License-Identifier: MIT
#include "vo/geometry/two_view.h"

#include <gmock/gmock.h>

#include <numbers>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/geometry/essential_matrix.h"

namespace corvo {
namespace {

/// Returns matched rays of the scene's points in two views, with uniform noise of up to `sigma_px`
/// in x and y at f = 500 px; every `wrong_every`-th match is wrong (0: none).
std::vector<RayMatch> MatchViews(const test::PointScene& scene, const SE3& first_from_second,
                                 double sigma_px, int wrong_every, test::Random& random) {
  constexpr double kFocal = 500;
  std::vector<RayMatch> matches;
  for (const Eigen::Vector3d& in_first : scene.in_world) {
    const Eigen::Vector3d in_second = first_from_second.Inverse() * in_first;
    RayMatch match;
    match.first = in_first.hnormalized() + random.Vector<2>(sigma_px / kFocal);
    match.second = in_second.hnormalized() + random.Vector<2>(sigma_px / kFocal);
    match.sigma = 1 / kFocal;
    if (wrong_every > 0 && matches.size() % wrong_every == 0) match.second += random.Vector<2>(0.5);
    matches.push_back(match);
  }
  return matches;
}

double DirectionErrorDeg(const SE3& estimate, const SE3& truth) {
  const Eigen::Vector3d a = estimate.translation().normalized();
  const Eigen::Vector3d b = truth.translation().normalized();
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

class TwoViewMotionTest : public ::testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(TwoViewMotionTest, FindsTheMotionDespiteWrongMatches) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 15, random);
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), GetParam());
  const TwoViewResult result =
      EstimateTwoViewMotion(MatchViews(scene, truth, 0.5, 4, random), InitializerOptions());
  EXPECT_EQ(result.reason, Reason::kNone) << ToString(result.reason);
  EXPECT_THAT(result.first_from_second.rotation(), test::IsRotationNear(truth.rotation(), 0.3));
  EXPECT_LT(DirectionErrorDeg(result.first_from_second, truth), 3.0);
  EXPECT_NEAR(result.first_from_second.translation().norm(), 1, 1e-9);
  EXPECT_GT(result.points.size(), 200u);
  const double scale = truth.translation().norm();
  int num_near = 0;
  for (const TwoViewPoint& point : result.points) {
    const Eigen::Vector3d expected = scene.in_world[point.match] / scale;
    num_near += (point.in_first - expected).norm() < 0.15 * expected.norm();
  }
  EXPECT_GT(num_near, 0.8 * static_cast<double>(result.points.size()));
}

INSTANTIATE_TEST_SUITE_P(Directions, TwoViewMotionTest,
                         ::testing::Values(Eigen::Vector3d(0.6, 0, 0), Eigen::Vector3d(0, 0.6, 0),
                                           Eigen::Vector3d(0, 0, 1.2),
                                           Eigen::Vector3d(0.4, -0.2, -0.5)));

/// Returns matches of a low and wide image, as of a camera on a vehicle, that moves forward by a
/// tenth of the distance of the nearest points.
std::vector<RayMatch> MatchForwardViews(const SE3& first_from_second, test::Random& random) {
  constexpr double kFocal = 300;
  std::vector<RayMatch> matches;
  while (matches.size() < 340) {
    const Eigen::Vector3d sample = random.Vector<3>(1);
    const double depth = 19 + 11 * sample.z();
    const Eigen::Vector3d in_first(sample.x() * depth, 0.3 * sample.y() * depth, depth);
    const Eigen::Vector3d in_second = first_from_second.Inverse() * in_first;
    matches.push_back({in_first.hnormalized() + random.Vector<2>(1 / kFocal),
                       in_second.hnormalized() + random.Vector<2>(1 / kFocal), 1 / kFocal});
  }
  return matches;
}

double EssentialScore(const SE3& first_from_second, const std::vector<RayMatch>& matches) {
  const SE3 motion = first_from_second.Inverse();
  const SE3 normalized(motion.rotation(), motion.translation().normalized());
  return ScoreEssential(EssentialMatrix(normalized), matches).score;
}

TEST(TwoViewTest, TheTrueMotionExplainsHardlyMoreThanTheOneFound) {
  const SE3 truth(SO3::Exp({-0.001, 0, -0.002}), {-0.002, 0.001, 0.8});
  for (int seed = 0; seed < (test::IsShortRun() ? 20 : 100); ++seed) {
    test::Random random(seed);
    const std::vector<RayMatch> matches = MatchForwardViews(truth, random);
    const TwoViewResult result = EstimateTwoViewMotion(matches, InitializerOptions());
    ASSERT_EQ(result.reason, Reason::kNone) << seed;
    EXPECT_GT(EssentialScore(result.first_from_second, matches),
              0.96 * EssentialScore(truth, matches))
        << seed;
  }
}

/// On a motorway, much of what is seen is at infinity or moves with the camera: noise decides
/// whether it is triangulated before or behind the views, and says nothing against the motion.
TEST(TwoViewTest, PointsAtInfinityDoNotContradictTheMotion) {
  const SE3 truth(SO3::Exp({-0.001, 0, -0.002}), {-0.002, 0.001, 2});
  for (int seed = 0; seed < 20; ++seed) {
    test::Random random(seed);
    std::vector<RayMatch> matches = MatchForwardViews(truth, random);
    for (std::size_t i = 0; i < matches.size(); i += 3) {
      const Eigen::Vector3d turned = truth.rotation().Inverse() * matches[i].first.homogeneous();
      matches[i].second = turned.hnormalized() + random.Vector<2>(matches[i].sigma);
    }
    const TwoViewResult result = EstimateTwoViewMotion(matches, InitializerOptions());
    ASSERT_EQ(result.reason, Reason::kNone) << seed;
    EXPECT_LT(DirectionErrorDeg(result.first_from_second, truth), 3) << seed;
  }
}

TEST(TwoViewTest, PureRotationIsReportedFromItsLeastNumberOfMatchesOn) {
  test::Random random(2);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 15, random);
  const SE3 truth(SO3::Exp({0.02, 0.15, -0.03}), Eigen::Vector3d::Zero());
  std::vector<RayMatch> matches = MatchViews(scene, truth, 0.5, 0, random);
  matches.resize(InitializerOptions().min_rotation_matches);
  EXPECT_EQ(EstimateTwoViewMotion(matches, InitializerOptions()).reason, Reason::kRotationOnly);
  matches.pop_back();
  EXPECT_NE(EstimateTwoViewMotion(matches, InitializerOptions()).reason, Reason::kRotationOnly);
}

TEST(TwoViewTest, PureRotationIsReported) {
  test::Random random(2);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 15, random);
  const SE3 truth(SO3::Exp({0.02, 0.15, -0.03}), Eigen::Vector3d::Zero());
  const TwoViewResult result =
      EstimateTwoViewMotion(MatchViews(scene, truth, 0.5, 5, random), InitializerOptions());
  EXPECT_EQ(result.reason, Reason::kRotationOnly) << ToString(result.reason);
  ASSERT_TRUE(result.first_from_second_rotation);
  EXPECT_THAT(*result.first_from_second_rotation, test::IsRotationNear(truth.rotation(), 0.1));
}

TEST(TwoViewTest, FewMatchesSufficeForARotationButNotForATranslation) {
  test::Random random(8);
  const test::PointScene scene = test::MakeBoxScene(60, 3, 15, random);
  const SO3 turned = SO3::Exp({0.02, 0.15, -0.03});
  const auto estimate = [&](const Eigen::Vector3d& translation) {
    return EstimateTwoViewMotion(MatchViews(scene, SE3(turned, translation), 0.5, 5, random),
                                 InitializerOptions());
  };
  const TwoViewResult still = estimate(Eigen::Vector3d::Zero());
  ASSERT_TRUE(still.first_from_second_rotation);
  EXPECT_THAT(*still.first_from_second_rotation, test::IsRotationNear(turned, 0.2));
  const TwoViewResult moved = estimate(Eigen::Vector3d(0.6, 0, 0));
  EXPECT_FALSE(moved.first_from_second_rotation);
  EXPECT_EQ(moved.reason, Reason::kTooFewMatches) << ToString(moved.reason);
}

TEST(TwoViewTest, PureRotationIsDetectedByTheRemainingParallax) {
  test::Random random(9);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 15, random);
  const SO3 turned = SO3::Exp({0.02, 0.15, -0.03});
  double parallax_deg = 0;
  for (const double moved : {0.0, 0.1, 0.4, 1.6}) {
    const TwoViewResult result =
        CheckPureRotation(MatchViews(scene, SE3(turned, {moved, 0, 0}), 0.5, 0, random), {});
    EXPECT_EQ(result.first_from_second_rotation.has_value(), moved < 0.2) << moved;
    EXPECT_GT(result.parallax_deg, parallax_deg) << moved;
    parallax_deg = result.parallax_deg;
  }
}

TEST(TwoViewTest, AStaticCameraIsReportedAsLowParallax) {
  test::Random random(3);
  const test::PointScene scene = test::MakeBoxScene(400, 3, 15, random);
  const TwoViewResult result =
      EstimateTwoViewMotion(MatchViews(scene, SE3(), 0.5, 5, random), InitializerOptions());
  EXPECT_EQ(result.reason, Reason::kLowParallax) << ToString(result.reason);
}

TEST(TwoViewTest, APlanarSceneIsReported) {
  test::Random random(4);
  const test::PointScene scene = test::MakePlaneScene(400, 6, random);
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), Eigen::Vector3d(0.8, 0.1, 0));
  const TwoViewResult result =
      EstimateTwoViewMotion(MatchViews(scene, truth, 0.5, 0, random), InitializerOptions());
  EXPECT_EQ(result.reason, Reason::kPlanar) << ToString(result.reason);
  ASSERT_FALSE(result.planar_motions.empty());
}

TEST(TwoViewTest, APlanarMotionIsTriangulated) {
  test::Random random(4);
  const test::PointScene scene = test::MakePlaneScene(400, 6, random);
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), Eigen::Vector3d(0.8, 0.1, 0));
  const auto matches = MatchViews(scene, truth, 0.5, 0, random);
  const TwoViewResult result =
      TriangulatePlanarMotion(matches, {truth.Inverse(), Eigen::Vector3d::UnitZ()}, {});
  EXPECT_EQ(result.reason, Reason::kNone) << ToString(result.reason);
  EXPECT_NEAR(result.first_from_second.translation().norm(), 1, 1e-9);
  EXPECT_LT(DirectionErrorDeg(result.first_from_second, truth), 1e-6);
  EXPECT_GT(result.points.size(), 300u);
}

/// All points are far away but the first ones.
TEST(TwoViewTest, AsManyPointsAsAMapNeedsHaveToReachTheLeastParallax) {
  test::Random random(4);
  const SE3 truth(SO3(), {1, 0, 0});
  InitializerOptions options;
  options.min_points = 10;
  options.min_parallax_deg = 1;
  const auto reason = [&](int num_near) {
    test::PointScene scene = test::MakeBoxScene(60, 100, 110, random);
    for (int i = 0; i < num_near; ++i) scene.in_world[i] *= 20 / scene.in_world[i].z();
    const auto matches = MatchViews(scene, truth, 0, 0, random);
    return TriangulatePlanarMotion(matches, {truth.Inverse(), {0, 0, 1}}, options).reason;
  };
  EXPECT_EQ(reason(9), Reason::kLowParallax);
  EXPECT_EQ(reason(10), Reason::kNone);
}

TEST(TwoViewTest, NoParallaxIsBelowALimitOfZero) {
  test::Random random(4);
  const auto matches = MatchViews(test::MakeBoxScene(60, 3, 15, random), SE3(), 0, 0, random);
  InitializerOptions options;
  EXPECT_TRUE(CheckPureRotation(matches, options).first_from_second_rotation);
  options.min_parallax_sigmas = 0;
  EXPECT_FALSE(CheckPureRotation(matches, options).first_from_second_rotation);
}

TEST(TwoViewTest, UnrelatedViewsHaveNoMotion) {
  test::Random random(5);
  const test::PointScene scene = test::MakeBoxScene(200, 3, 15, random);
  const SE3 truth(SO3(), Eigen::Vector3d(0.5, 0, 0));
  EXPECT_NE(
      EstimateTwoViewMotion(MatchViews(scene, truth, 0, 1, random), InitializerOptions()).reason,
      Reason::kNone);
}

TEST(TwoViewTest, ScoresAreHighestForTheTrueModels) {
  test::Random random(7);
  const test::PointScene scene = test::MakePlaneScene(100, 5, random);
  const SE3 truth(SO3::Exp({0.02, 0.05, -0.03}), Eigen::Vector3d(0.5, 0.1, 0.2));
  const auto matches = MatchViews(scene, truth, 0, 0, random);
  const SE3 second_from_first = truth.Inverse();
  const Eigen::Matrix3d essential =
      SO3::Hat(second_from_first.translation()) * second_from_first.rotation().matrix();
  // MakePlaneScene() has the plane n·x = d: z - 0.3 x = 5. H = R + t nᵀ / d.
  const Eigen::Matrix3d homography =
      second_from_first.rotation().matrix() +
      second_from_first.translation() * Eigen::RowVector3d(-0.3, 0, 1) / 5;
  EXPECT_EQ(ScoreEssential(essential, matches).num_inliers, 100);
  EXPECT_EQ(ScoreHomography(homography, matches).num_inliers, 100);
  EXPECT_NEAR(ScoreEssential(essential, matches).score, ScoreHomography(homography, matches).score,
              1e-6);
  EXPECT_LT(ScoreEssential(Eigen::Matrix3d(essential.transpose()), matches).num_inliers, 50);
}

}  // namespace
}  // namespace corvo
