// SPDX-License-Identifier: MIT
#include "vo/geometry/two_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "vo/geometry/epipolar_motion.h"
#include "vo/geometry/essential_matrix.h"
#include "vo/geometry/rotation_estimator.h"
#include "vo/geometry/triangulation.h"
#include "vo/geometry/usac_params.h"
#include "vo/math/chi_square.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

double MedianSigma(const std::vector<RayMatch>& matches) {
  std::vector<double> sigmas;
  for (const RayMatch& match : matches) sigmas.push_back(match.sigma);
  return Median(std::move(sigmas));
}

struct CvMatches {
  std::vector<cv::Point2d> first, second;
};

CvMatches ToCv(const std::vector<RayMatch>& matches) {
  CvMatches points;
  for (const RayMatch& match : matches) {
    points.first.emplace_back(match.first.x(), match.first.y());
    points.second.emplace_back(match.second.x(), match.second.y());
  }
  return points;
}

std::optional<Eigen::Matrix3d> ToModel(const cv::Mat& matrix) {
  if (matrix.rows != 3 || matrix.cols != 3) return std::nullopt;
  Eigen::Matrix3d model;
  cv::cv2eigen(matrix, model);
  if (!model.allFinite()) return std::nullopt;
  return model;
}

/// Returns the four motions of an essential matrix E ~ [t]x R (Hartley and Zisserman, 9.6.2).
std::vector<SE3> DecomposeEssential(const Eigen::Matrix3d& essential) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() < 0) u = -u;
  if (v.determinant() < 0) v = -v;
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SO3 a(Eigen::Matrix3d(u * w * v.transpose()));
  const SO3 b(Eigen::Matrix3d(u * w.transpose() * v.transpose()));
  const Eigen::Vector3d t = u.col(2);
  return {SE3(a, t), SE3(a, -t), SE3(b, t), SE3(b, -t)};
}

std::optional<Eigen::Matrix3d> SampleEssential(const std::vector<RayMatch>& matches) {
  const CvMatches points = ToCv(matches);
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  const double threshold = std::sqrt(kChiSquare1Dof95) * MedianSigma(matches);
  cv::Mat mask;
  return ToModel(cv::findEssentialMat(points.first, points.second, identity, identity,
                                      cv::noArray(), cv::noArray(), mask,
                                      MakeUsacParams(threshold)));
}

/// Returns the sampled essential matrix or a fitted one that explains clearly more. A sample may
/// have most matches as inliers and still another motion: where the parallax is small, a rotation
/// looks like a motion to the side. So motions along each axis are fitted, too, from the `rotation`
/// that explains the matches best.
std::optional<Eigen::Matrix3d> FindEssential(const std::vector<RayMatch>& matches,
                                             const SO3& rotation) {
  constexpr double kClearlyMore = 1.03;
  std::optional<Eigen::Matrix3d> best = SampleEssential(matches);
  double best_score = best ? kClearlyMore * ScoreEssential(*best, matches).score : 0;
  for (const auto& fit : FitEpipolarMotionsAlongAxes(matches, rotation)) {
    const Eigen::Matrix3d essential =
        EssentialMatrix(SE3(fit.state.second_from_first, fit.state.baseline));
    const double score = ScoreEssential(essential, matches).score;
    if (score <= best_score) continue;
    best_score = score;
    best = essential;
  }
  return best;
}

std::optional<Eigen::Matrix3d> FindHomography(const std::vector<RayMatch>& matches) {
  const CvMatches points = ToCv(matches);
  const double threshold = std::sqrt(kChiSquare2Dof95) * MedianSigma(matches);
  cv::Mat mask;
  return ToModel(cv::findHomography(points.first, points.second, mask, MakeUsacParams(threshold)));
}

/// Adds one error to a score; both errors of a match must lie within `bound` for an inlier.
void AddToScore(double first_error, double second_error, double bound, ModelScore& score) {
  const bool is_inlier = first_error <= bound && second_error <= bound;
  if (first_error <= bound) score.score += kChiSquare2Dof95 - first_error;
  if (second_error <= bound) score.score += kChiSquare2Dof95 - second_error;
  score.is_inlier.push_back(is_inlier);
  score.num_inliers += is_inlier;
}

/// Returns the squared distance of a ray from a line in its view.
double SquaredLineDistance(const Eigen::Vector3d& line, const Eigen::Vector2d& ray) {
  const double distance = line.dot(ray.homogeneous());
  return distance * distance / line.head<2>().squaredNorm();
}

double SquaredTransferError(const Eigen::Matrix3d& homography, const Eigen::Vector2d& from,
                            const Eigen::Vector2d& to) {
  return ((homography * from.homogeneous()).hnormalized() - to).squaredNorm();
}

bool ReprojectsWithin(const Eigen::Vector3d& in_view, const Eigen::Vector2d& ray, double sigma) {
  if (in_view.z() <= 0) return false;
  return (in_view.hnormalized() - ray).squaredNorm() <= kChiSquare2Dof95 * sigma * sigma;
}

/// Returns whether the rays of a match agree, once turned, within their uncertainty: whether its
/// point may be at infinity, so that noise decides on which side of the views it is triangulated.
bool MayBeAtInfinity(const RayMatch& match, const SO3& second_from_first) {
  const Eigen::Vector2d turned = (second_from_first * match.first.homogeneous()).hnormalized();
  const double variance = 2 * match.sigma * match.sigma;
  return (turned - match.second).squaredNorm() <= kChiSquare2Dof95 * variance;
}

/// What the inliers of one motion are triangulated to.
struct TriangulatedInliers {
  std::vector<TwoViewPoint> points;  ///< In front of both views, with a low reprojection error.
  int num_finite_points = 0;         ///< Those that cannot be at infinity.
  int num_finite = 0;                ///< Inliers that cannot be at infinity.
};

/// Returns the share of the inliers that are in front of both views; of those that cannot be at
/// infinity, if there are at least `min_finite`.
double ShareInFront(const TriangulatedInliers& inliers, int num_inliers, int min_finite) {
  if (inliers.num_finite >= min_finite) return 1.0 * inliers.num_finite_points / inliers.num_finite;
  return static_cast<double>(inliers.points.size()) / std::max(1, num_inliers);
}

TriangulatedInliers TriangulateInliers(const std::vector<RayMatch>& matches,
                                       const std::vector<char>& is_inlier,
                                       const SE3& second_from_first) {
  TriangulatedInliers result;
  const SE3 first_from_second = second_from_first.Inverse();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!is_inlier[i]) continue;
    const RayMatch& match = matches[i];
    const bool is_finite = !MayBeAtInfinity(match, second_from_first.rotation());
    result.num_finite += is_finite;
    const auto in_first = Triangulate({SE3(), match.first}, {first_from_second, match.second});
    if (!in_first || !ReprojectsWithin(*in_first, match.first, match.sigma)) continue;
    if (!ReprojectsWithin(second_from_first * *in_first, match.second, match.sigma)) continue;
    result.points.push_back(
        {static_cast<int>(i), *in_first, ParallaxAngle(*in_first, SE3(), first_from_second)});
    result.num_finite_points += is_finite;
  }
  return result;
}

/// Returns the parallax that `min_points` points reach, radians. There must be as many.
double ParallaxReached(const std::vector<TwoViewPoint>& points, int min_points) {
  std::vector<double> angles;
  for (const TwoViewPoint& point : points) angles.push_back(point.parallax);
  std::sort(angles.begin(), angles.end(), std::greater<>());
  return angles[min_points - 1];
}

/// Selects the motion with the most points in front of both views, or sets the reason why none is
/// accepted.
void SelectMotion(const std::vector<SE3>& second_from_first, const ModelScore& score,
                  const std::vector<RayMatch>& matches, const InitializerOptions& options,
                  TwoViewResult& result) {
  std::size_t second_best = 0;
  double share_in_front = 0;
  for (const SE3& motion : second_from_first) {
    TriangulatedInliers inliers = TriangulateInliers(matches, score.is_inlier, motion);
    if (inliers.points.size() > result.points.size()) {
      second_best = result.points.size();
      share_in_front = ShareInFront(inliers, score.num_inliers, options.min_matches);
      result.points = std::move(inliers.points);
      result.first_from_second = motion.Inverse();
    } else {
      second_best = std::max(second_best, inliers.points.size());
    }
  }
  const double num_points = static_cast<double>(result.points.size());
  const bool is_unique =
      static_cast<double>(second_best) < options.max_second_motion_share * num_points;
  const bool is_enough =
      num_points >= options.min_points && share_in_front >= options.min_share_in_front;
  const double min_parallax = options.min_parallax_deg * std::numbers::pi / 180;
  if (!is_unique) {
    result.reason = Reason::kAmbiguousMotion;
  } else if (!is_enough) {
    result.reason = Reason::kBadTriangulation;
  } else if (ParallaxReached(result.points, options.min_points) < min_parallax) {
    result.reason = Reason::kLowParallax;
  }
}

/// Returns whether a plane explains the matches; if so, sets the reason and the motions that the
/// plane allows.
bool CheckPlane(const Eigen::Matrix3d& homography, const ModelScore& essential_score,
                const std::vector<RayMatch>& matches, const InitializerOptions& options,
                TwoViewResult& result) {
  const ModelScore score = ScoreHomography(homography, matches);
  const double share = score.score / (score.score + essential_score.score);
  if (!(share > options.max_homography_share)) return false;
  result.reason = Reason::kPlanar;
  result.planar_motions =
      DecomposeHomography(homography, matches, score.is_inlier, options.min_share_before_plane);
  return true;
}

/// Checks whether the rotation that explains the matches best is all of the motion.
TwoViewResult CheckPureRotation(const std::vector<RayMatch>& matches, const SO3& second_from_first,
                                const InitializerOptions& options) {
  TwoViewResult result;
  const double parallax = Median(ComputeParallax(matches, second_from_first));
  result.parallax_deg = parallax * 180 / std::numbers::pi;
  const double max_parallax = options.min_parallax_sigmas * MedianSigma(matches);
  const bool is_enough = static_cast<int>(matches.size()) >= options.min_rotation_matches;
  if (!is_enough || parallax >= max_parallax) return result;
  result.first_from_second_rotation = second_from_first.Inverse();
  const double min_turn = options.min_parallax_deg * std::numbers::pi / 180;
  const bool turned = second_from_first.Angle() > min_turn;
  result.reason = turned ? Reason::kRotationOnly : Reason::kLowParallax;
  return result;
}

}  // namespace

ModelScore ScoreEssential(const Eigen::Matrix3d& essential, const std::vector<RayMatch>& matches) {
  ModelScore score;
  for (const RayMatch& match : matches) {
    const double variance = match.sigma * match.sigma;
    const Eigen::Vector3d line_in_second = essential * match.first.homogeneous();
    const Eigen::Vector3d line_in_first = essential.transpose() * match.second.homogeneous();
    AddToScore(SquaredLineDistance(line_in_first, match.first) / variance,
               SquaredLineDistance(line_in_second, match.second) / variance, kChiSquare1Dof95,
               score);
  }
  return score;
}

ModelScore ScoreHomography(const Eigen::Matrix3d& homography,
                           const std::vector<RayMatch>& matches) {
  ModelScore score;
  const Eigen::Matrix3d inverse = homography.inverse();
  for (const RayMatch& match : matches) {
    const double variance = match.sigma * match.sigma;
    AddToScore(SquaredTransferError(inverse, match.second, match.first) / variance,
               SquaredTransferError(homography, match.first, match.second) / variance,
               kChiSquare2Dof95, score);
  }
  return score;
}

TwoViewResult CheckPureRotation(const std::vector<RayMatch>& matches,
                                const InitializerOptions& options) {
  return CheckPureRotation(matches, EstimateRotation(matches), options);
}

TwoViewResult EstimateTwoViewMotion(const std::vector<RayMatch>& matches,
                                    const InitializerOptions& options) {
  const SO3 rotation = EstimateRotation(matches);
  TwoViewResult result = CheckPureRotation(matches, rotation, options);
  if (result.first_from_second_rotation) return result;
  if (static_cast<int>(matches.size()) < options.min_matches) {
    result.reason = Reason::kTooFewMatches;
    return result;
  }
  const auto essential = FindEssential(matches, rotation);
  const auto homography = FindHomography(matches);
  if (!essential) {
    result.reason = Reason::kAmbiguousMotion;
    return result;
  }
  const ModelScore essential_score = ScoreEssential(*essential, matches);
  result.num_inliers = essential_score.num_inliers;
  if (homography && CheckPlane(*homography, essential_score, matches, options, result)) {
    return result;
  }
  SelectMotion(DecomposeEssential(*essential), essential_score, matches, options, result);
  return result;
}

TwoViewResult TriangulatePlanarMotion(const std::vector<RayMatch>& matches,
                                      const PlanarMotion& motion,
                                      const InitializerOptions& options) {
  TwoViewResult result;
  const SE3 second_from_first(motion.second_from_first.rotation(),
                              motion.second_from_first.translation().normalized());
  const ModelScore score = ScoreEssential(EssentialMatrix(second_from_first), matches);
  result.num_inliers = score.num_inliers;
  result.parallax_deg =
      Median(ComputeParallax(matches, EstimateRotation(matches))) * 180 / std::numbers::pi;
  SelectMotion({second_from_first}, score, matches, options, result);
  return result;
}

}  // namespace corvo
