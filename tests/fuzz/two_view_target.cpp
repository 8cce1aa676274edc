// SPDX-License-Identifier: MIT
#include <vector>

#include "tests/fuzz/targets.h"
#include "vo/geometry/rotation_estimator.h"
#include "vo/geometry/triangulation.h"
#include "vo/geometry/two_view.h"

namespace corvo::fuzz {
namespace {

/// How the points of a scene lie.
enum class Layout { kBox, kPlane, kLine, kPoint, kFar, kOwnRays };

Eigen::Vector3d TakePoint(Layout layout, Input& input) {
  const double x = input.Real(-3, 3), y = input.Real(-3, 3);
  switch (layout) {
    case Layout::kPlane:
      return {x, y, 4};
    case Layout::kLine:
      return {x, 0.5 * x, 4};
    case Layout::kPoint:
      return {1, 1, 4};
    case Layout::kFar:
      return {1e9 * x, 1e9 * y, 4e9};
    default:
      return {x, y, input.Real(0.1, 10)};
  }
}

/// Returns rays as an image gives them: within 89 degrees of the axis.
Eigen::Vector2d Clamped(const Eigen::Vector2d& ray) { return ray.cwiseMax(-57.0).cwiseMin(57.0); }

RayMatch TakeMatch(Layout layout, const SE3& second_from_first, double noise, Input& input) {
  RayMatch match;
  if (layout == Layout::kOwnRays) {
    const double a = input.Number(57), b = input.Number(57);
    const double c = input.Number(57), d = input.Number(57);
    match = {{a, b}, {c, d}, 1e-3};
  } else {
    const Eigen::Vector3d in_first = TakePoint(layout, input);
    Eigen::Vector3d in_second = second_from_first * in_first;
    if (in_second.z() < 1e-3) in_second.z() = 1e-3;
    match.first = Clamped(in_first.hnormalized());
    match.second = Clamped(in_second.hnormalized() + noise * input.Vector(1).head<2>());
  }
  return match;
}

void RequireResult(const TwoViewResult& result, std::size_t num_matches) {
  Require(IsFinite(result.first_from_second), "a motion is finite");
  Require(std::isfinite(result.parallax_deg), "the parallax is finite");
  for (const TwoViewPoint& point : result.points) {
    Require(point.match >= 0 && point.match < static_cast<int>(num_matches), "points have matches");
    Require(point.in_first.allFinite() && std::isfinite(point.parallax), "points are finite");
  }
}

void RequireTriangulation(const RayMatch& match, const SE3& first_from_second) {
  const PosedRay first{SE3(), match.first}, second{first_from_second, match.second};
  if (const auto point = Triangulate(first, second)) {
    Require(point->allFinite(), "a triangulated point is finite");
  }
  Require(std::isfinite(RayAngle(first, second)), "the angle between rays is finite");
}

}  // namespace

void FuzzTwoView(Bytes bytes) {
  Input input(bytes);
  const auto layout = static_cast<Layout>(input.Int(0, 5));
  const int num_matches = input.Int(0, 60), num_repeated = input.Int(0, 30);
  const double noise = input.Bool() ? 0 : input.Real(0, 0.1);
  const double sigma = std::pow(10, input.Real(-6, 0));
  const Eigen::Vector3d turn = input.Bool() ? Eigen::Vector3d::Zero() : input.Vector(1);
  const Eigen::Vector3d baseline = input.Bool() ? Eigen::Vector3d::Zero() : input.Vector(1);
  const SE3 second_from_first(SO3::Exp(turn), baseline);
  std::vector<RayMatch> matches;
  for (int i = 0; i < num_matches; ++i) {
    matches.push_back(TakeMatch(layout, second_from_first, noise, input));
    matches.back().sigma = sigma;
    RequireTriangulation(matches.back(), second_from_first.Inverse());
  }
  for (int i = 0; i < num_repeated && !matches.empty(); ++i) matches.push_back(matches.front());
  InitializerOptions options;
  options.min_matches = 20;
  options.min_points = 10;
  options.min_rotation_matches = 3;
  AllowError([&] {
    const TwoViewResult result = EstimateTwoViewMotion(matches, options);
    RequireResult(result, matches.size());
    for (const PlanarMotion& motion : result.planar_motions) {
      RequireResult(TriangulatePlanarMotion(matches, motion, options), matches.size());
    }
    const SO3 rotation = EstimateRotation(matches);
    Require(rotation.matrix().allFinite(), "a rotation is finite");
    Require(RefineRotation(matches, rotation).matrix().allFinite(), "a rotation is finite");
  });
}

}  // namespace corvo::fuzz
