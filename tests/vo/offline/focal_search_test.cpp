// SPDX-License-Identifier: MIT
#include "vo/offline/focal_search.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <vector>

#include "orb/error.h"
#include "tests/support/data.h"
#include "tests/support/point_scene.h"
#include "vo/lie/se3.h"

namespace corvo {
namespace {

constexpr int kWidth = 640;
constexpr int kImageHeight = 480;

/// Parameters of simulated pairs of images of a scene.
struct ViewPair {
  double focal = 500;
  double noise_px = 0;
  int wrong_every = 0;  ///< Every `wrong_every`-th match is wrong; 0: none.
  bool is_plane = false;
  int num_pairs = 8;
  std::function<SE3(test::Random&)> first_from_second;
};

SE3 TurnAndMove(test::Random& random) {
  return SE3(SO3::Exp(random.Vector<3>(0.15)), random.Vector<3>(0.8));
}

SE3 Turn(test::Random& random) { return SE3(SO3::Exp(random.Vector<3>(0.2)), {0, 0, 0}); }

SE3 MoveForward(test::Random& random) { return SE3(SO3(), {0, 0, random.Uniform(0.3, 0.8)}); }

SE3 MoveAside(test::Random& random) { return SE3(SO3(), {random.Uniform(0.3, 0.8), 0.1, 0}); }

PixelMatches MatchViews(const ViewPair& pair, test::Random& random) {
  const Camera camera({.width = kWidth,
                       .height = kImageHeight,
                       .fx = pair.focal,
                       .fy = pair.focal,
                       .cx = 0.5 * (kWidth - 1),
                       .cy = 0.5 * (kImageHeight - 1)});
  const test::PointScene scene =
      pair.is_plane ? test::MakePlaneScene(600, 6, random) : test::MakeBoxScene(600, 3, 12, random);
  const SE3 second_from_first = pair.first_from_second(random).Inverse();
  PixelMatches matches;
  for (const Eigen::Vector3d& in_first : scene.in_world) {
    const auto first = camera.Project(in_first);
    const auto second = camera.Project(second_from_first * in_first);
    if (!first || !second || !camera.Contains(*first) || !camera.Contains(*second)) continue;
    PixelMatch match{*first, *second, 1};
    for (double& u : match.first) u += random.Gaussian(pair.noise_px);
    for (double& u : match.second) u += random.Gaussian(pair.noise_px);
    if (pair.wrong_every > 0 && matches.size() % pair.wrong_every == 0) {
      match.second = {random.Uniform(0, kWidth), random.Uniform(0, kImageHeight)};
    }
    matches.push_back(match);
  }
  return matches;
}

FocalSearchResult Search(const ViewPair& pair, int seed = 1) {
  test::Random random(seed);
  std::vector<PixelMatches> pairs;
  for (int i = 0; i < pair.num_pairs; ++i) pairs.push_back(MatchViews(pair, random));
  return SearchFocal(pairs, kWidth, kImageHeight);
}

class FocalSearchTest : public ::testing::TestWithParam<double> {};

TEST_P(FocalSearchTest, IsExactWithoutNoise) {
  CORVO_SKIP_IF_SHORT();
  const FocalSearchResult result = Search({.focal = GetParam(), .first_from_second = TurnAndMove});
  EXPECT_TRUE(result.is_determined);
  EXPECT_EQ(result.num_pairs, 8);
  EXPECT_NEAR(result.camera.fx / GetParam(), 1, 0.01);
}

TEST_P(FocalSearchTest, ReportsItsErrorWithNoiseAndWrongMatches) {
  CORVO_SKIP_IF_SHORT();
  for (int seed = 1; seed <= 3; ++seed) {
    const FocalSearchResult result = Search(
        {.focal = GetParam(), .noise_px = 0.7, .wrong_every = 5, .first_from_second = TurnAndMove},
        seed);
    EXPECT_TRUE(result.is_determined) << result.focal_sigma;
    const double error = std::abs(std::log(result.camera.fx / GetParam()));
    EXPECT_LT(error, 0.04);
    EXPECT_LT(error, 3.5 * result.focal_sigma);
  }
}

TEST_P(FocalSearchTest, RotationDeterminesTheFocalLength) {
  if (GetParam() < 900) CORVO_SKIP_IF_SHORT();  // One lens is enough for the sanitizers.
  const FocalSearchResult result =
      Search({.focal = GetParam(), .noise_px = 0.5, .wrong_every = 6, .first_from_second = Turn});
  EXPECT_TRUE(result.is_determined) << result.focal_sigma;
  EXPECT_NEAR(result.camera.fx / GetParam(), 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Lenses, FocalSearchTest, ::testing::Values(280.0, 500.0, 900.0));

TEST(FocalSearch, StraightMotionOrAPlaneDoesNotDetermineTheFocalLength) {
  CORVO_SKIP_IF_SHORT();
  for (const auto& motion : {MoveForward, MoveAside}) {
    const FocalSearchResult straight = Search({.noise_px = 0.5, .first_from_second = motion});
    EXPECT_FALSE(straight.is_determined) << straight.camera.fx << " " << straight.focal_sigma;
    EXPECT_GT(straight.focal_sigma, 0.15);
  }
  const FocalSearchResult plane =
      Search({.noise_px = 0.5, .is_plane = true, .first_from_second = TurnAndMove});
  EXPECT_FALSE(plane.is_determined) << plane.camera.fx << " " << plane.focal_sigma;
}

TEST(FocalSearch, UninformativePairsDoNotHideInformativeOnes) {
  CORVO_SKIP_IF_SHORT();
  test::Random random(3);
  std::vector<PixelMatches> pairs;
  for (int i = 0; i < 12; ++i) {
    const bool turns = i % 3 == 0;
    pairs.push_back(MatchViews(
        {.noise_px = 0.5, .first_from_second = turns ? TurnAndMove : MoveForward}, random));
  }
  const FocalSearchResult result = SearchFocal(pairs, kWidth, kImageHeight);
  EXPECT_TRUE(result.is_determined) << result.focal_sigma;
  EXPECT_NEAR(result.camera.fx / 500, 1, 0.03);
}

/// The pairs contradict each other, so that the variance is that of their disagreement.
TEST(FocalSearch, TwiceTheSamePairsHalveTheVariance) {
  CORVO_SKIP_IF_SHORT();
  test::Random random(2);
  std::vector<PixelMatches> pairs;
  for (const double focal : {498.0, 502.0}) {
    pairs.push_back(
        MatchViews({.focal = focal, .noise_px = 0.1, .first_from_second = TurnAndMove}, random));
  }
  const FocalSearchResult once = SearchFocal(pairs, kWidth, kImageHeight);
  pairs.insert(pairs.end(), {pairs[0], pairs[1]});
  const FocalSearchResult twice = SearchFocal(pairs, kWidth, kImageHeight);
  EXPECT_NEAR(std::pow(twice.focal_sigma / once.focal_sigma, 2), 0.5, 1e-9);
  EXPECT_NEAR(twice.camera.fx, once.camera.fx, 1e-9);
}

TEST(FocalSearch, AFocalLengthOutsideTheSweepIsNotDetermined) {
  test::Random random(1);
  const std::vector<PixelMatches> pairs = {MatchViews({.first_from_second = TurnAndMove}, random)};
  FocalSearchOptions options;
  options.max_fov_deg = 50;  // That of the images is 65.
  EXPECT_FALSE(SearchFocal(pairs, kWidth, kImageHeight, options).is_determined);
}

TEST(FocalSearch, ReturnsACenteredPinholeCameraAndTheSweep) {
  const FocalSearchResult result = Search({.num_pairs = 2, .first_from_second = TurnAndMove});
  EXPECT_EQ(result.camera.cx, 319.5);
  EXPECT_EQ(result.camera.cy, 239.5);
  EXPECT_EQ(result.camera.fx, result.camera.fy);
  EXPECT_EQ(result.camera.k1, 0);
  ASSERT_GT(result.sweep.size(), 20u);
  EXPECT_NEAR(result.sweep.front().fov_deg, 25, 1e-9);
  EXPECT_NEAR(result.sweep.back().fov_deg, 120, 1e-9);
}

TEST(FocalSearch, WithoutMatchesReturnsADefaultLensAsUndetermined) {
  for (const auto& pairs : {std::vector<PixelMatches>{}, std::vector<PixelMatches>(3)}) {
    const FocalSearchResult result = SearchFocal(pairs, kWidth, kImageHeight);
    EXPECT_EQ(result.num_pairs, 0);
    EXPECT_FALSE(result.is_determined);
    EXPECT_TRUE(std::isinf(result.focal_sigma));
    EXPECT_NEAR(result.camera.fx, 457, 1);  // Field of view: 70 degrees.
  }
  EXPECT_THROW(SearchFocal({}, 0, kImageHeight), Error);
}

TEST(FocalSearch, ResultIsIdenticalWhenRepeated) {
  CORVO_SKIP_IF_SHORT();
  const ViewPair pair = {.noise_px = 0.7, .wrong_every = 4, .first_from_second = TurnAndMove};
  const FocalSearchResult once = Search(pair);
  const FocalSearchResult again = Search(pair);
  EXPECT_EQ(once.camera, again.camera);
  EXPECT_EQ(once.focal_sigma, again.focal_sigma);
}

}  // namespace
}  // namespace corvo
