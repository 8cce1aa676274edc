// SPDX-License-Identifier: MIT
#include "vo/offline/focal_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "orb/error.h"
#include "vo/camera/centered_pinhole.h"
#include "vo/core/option_fields.h"
#include "vo/geometry/epipolar_motion.h"
#include "vo/geometry/ray_match.h"
#include "vo/geometry/rotation_estimator.h"
#include "vo/geometry/usac_params.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

FocalCandidate MakeCandidate(double focal, double width, double cost) {
  return {focal, FovOfFocal(focal, width), cost};
}

std::optional<Eigen::Matrix3d> FindFundamental(const PixelMatches& matches, double max_error_px) {
  std::vector<cv::Point2d> first, second;
  for (const PixelMatch& match : matches) {
    first.emplace_back(match.first.x(), match.first.y());
    second.emplace_back(match.second.x(), match.second.y());
  }
  cv::Mat mask;
  const cv::Mat found = cv::findFundamentalMat(first, second, mask, MakeUsacParams(max_error_px));
  if (found.rows != 3 || found.cols != 3) return std::nullopt;
  Eigen::Matrix3d fundamental;
  cv::cv2eigen(found, fundamental);
  if (!fundamental.allFinite()) return std::nullopt;
  return fundamental;
}

/// Returns the Sampson error of a match in units of its sigma.
double SampsonError(const Eigen::Matrix3d& fundamental, const PixelMatch& match) {
  const Eigen::Vector3d in_second = fundamental * match.first.homogeneous();
  const Eigen::Vector3d in_first = fundamental.transpose() * match.second.homogeneous();
  const double norm =
      std::sqrt(in_second.head<2>().squaredNorm() + in_first.head<2>().squaredNorm());
  return std::abs(match.second.homogeneous().dot(in_second)) / (norm * match.sigma);
}

/// The inlier matches of a pair, with pixels relative to the image center.
struct Pair {
  PixelMatches matches;
  Eigen::Matrix3d fundamental;
  double noise = 0;  // Median Sampson error as a standard deviation, in units of the sigmas.
};

/// Returns a pair, or std::nullopt unless enough matches agree with one fundamental matrix.
std::optional<Pair> MakePair(const PixelMatches& matches, const Eigen::Vector2d& center,
                             const FocalSearchOptions& options) {
  constexpr double kNormalFromMedian = 1.4826;
  const std::size_t min_matches = options.min_matches;
  if (matches.size() < min_matches) return std::nullopt;
  PixelMatches centered = matches;
  for (PixelMatch& match : centered) {
    match.first -= center;
    match.second -= center;
  }
  const std::optional<Eigen::Matrix3d> fundamental =
      FindFundamental(centered, options.max_error_px);
  if (!fundamental) return std::nullopt;
  Pair pair{{}, *fundamental, 0};
  std::vector<double> errors;
  for (const PixelMatch& match : centered) {
    const double error = SampsonError(*fundamental, match);
    if (!(error < options.max_error_sigmas)) continue;
    pair.matches.push_back(match);
    errors.push_back(error);
  }
  if (errors.size() < min_matches) return std::nullopt;
  pair.noise = kNormalFromMedian * Median(std::move(errors));
  return pair;
}

/// Returns the motion nearest to the essential matrix of a focal length (Hartley and Zisserman,
/// 9.6.2). The choice among its four motions does not affect epipolar lines.
EpipolarMotion MotionOf(const Eigen::Matrix3d& fundamental, double focal) {
  const Eigen::DiagonalMatrix<double, 3> calibration(focal, focal, 1);
  const Eigen::Matrix3d essential = calibration * fundamental * calibration;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Eigen::Matrix3d rotation = svd.matrixU() * w * svd.matrixV().transpose();
  if (rotation.determinant() < 0) rotation = -rotation;
  return {SO3(rotation), svd.matrixU().col(2)};
}

std::vector<RayMatch> ToRays(const PixelMatches& matches, double focal, double noise) {
  std::vector<RayMatch> rays;
  rays.reserve(matches.size());
  for (const PixelMatch& match : matches) {
    rays.push_back({match.first / focal, match.second / focal, noise * match.sigma / focal});
  }
  return rays;
}

using EpipolarFit = Minimum<EpipolarMotion>;

void Improve(EpipolarFit fit, EpipolarFit& best) {
  if (fit.cost < best.cost) best = std::move(fit);
}

/// Adds the squared distance of a match's rotated first ray from its second, in units of its sigma,
/// under Cauchy's loss. A step ω updates R to Exp(ω) R.
void AddTransferError(const RayMatch& match, const SO3& rotation, NormalEquations<3>& equations) {
  const Eigen::Vector3d turned = rotation * match.first.homogeneous();
  if (turned.z() <= 0) return;
  const Eigen::Vector2d ray = turned.hnormalized();
  const Eigen::Vector2d error = (ray - match.second) / match.sigma;
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << 1, 0, -ray.x(), 0, 1, -ray.y();
  const Eigen::Matrix<double, 2, 3> by_step =
      -by_point * SO3::Hat(turned) / (turned.z() * match.sigma);
  const double weight = 1 / (1 + error.squaredNorm());
  equations.cost += std::log1p(error.squaredNorm());
  equations.hessian += weight * by_step.transpose() * by_step;
  equations.gradient += weight * by_step.transpose() * error;
}

/// Returns the least robust transfer error of a rotation. It has two components for each match,
/// that of FitEpipolarMotion() only one.
double RotationCost(const std::vector<RayMatch>& matches) {
  constexpr int kMaxIterations = 10;
  const auto build = [&](const SO3& rotation) {
    NormalEquations<3> equations;
    for (const RayMatch& match : matches) AddTransferError(match, rotation, equations);
    return equations;
  };
  const auto plus = [](const SO3& rotation, const Eigen::Vector3d& step) {
    return SO3::Exp(step) * rotation;
  };
  return MinimizeLevenbergMarquardt<3>(EstimateRotation(matches), build, plus, kMaxIterations).cost;
}

/// Returns the costs of one pair explained by a rotation, one for each focal length.
std::vector<double> RotationCosts(const Pair& pair, const std::vector<double>& focals,
                                  double noise) {
  std::vector<double> costs;
  for (const double focal : focals) {
    costs.push_back(RotationCost(ToRays(pair.matches, focal, noise)));
  }
  return costs;
}

/// Returns the costs of one pair explained by a motion, one for each focal length. Each fit starts
/// from the fundamental matrix and from the best motions of the neighboring focal lengths, so that
/// none stays in a local minimum of its own.
std::vector<double> EpipolarCosts(const Pair& pair, const std::vector<double>& focals,
                                  double noise) {
  std::vector<EpipolarFit> fits;
  for (const double focal : focals) {
    const std::vector<RayMatch> rays = ToRays(pair.matches, focal, noise);
    EpipolarFit fit = FitEpipolarMotion(rays, MotionOf(pair.fundamental, focal));
    if (!fits.empty()) Improve(FitEpipolarMotion(rays, fits.back().state), fit);
    fits.push_back(std::move(fit));
  }
  for (int i = static_cast<int>(focals.size()) - 2; i >= 0; --i) {
    const std::vector<RayMatch> rays = ToRays(pair.matches, focals[i], noise);
    Improve(FitEpipolarMotion(rays, fits[i + 1].state), fits[i]);
  }
  std::vector<double> costs;
  for (const EpipolarFit& fit : fits) costs.push_back(fit.cost);
  return costs;
}

/// Returns whether a rotation explains a pair better than a motion. A rotation costs two errors for
/// each match and no depth, a motion one error and a depth: for matches without parallax the robust
/// cost of the rotation is higher by 0.39 each, and parallax of one sigma adds 0.3.
bool IsRotation(double rotation_cost, double epipolar_cost, std::size_t num_matches,
                double max_excess) {
  return rotation_cost < epipolar_cost + max_excess * static_cast<double>(num_matches);
}

/// Returns a pair's costs over the focal lengths, by the model that explains the pair.
std::vector<double> PairCosts(const Pair& pair, const std::vector<double>& focals, double noise,
                              double max_rotation_excess) {
  std::vector<double> epipolar = EpipolarCosts(pair, focals, noise);
  std::vector<double> rotation = RotationCosts(pair, focals, noise);
  const double least_epipolar = *std::min_element(epipolar.begin(), epipolar.end());
  const double least_rotation = *std::min_element(rotation.begin(), rotation.end());
  const bool is_rotation =
      IsRotation(least_rotation, least_epipolar, pair.matches.size(), max_rotation_excess);
  return is_rotation ? rotation : epipolar;
}

/// The costs by pair and focal length.
struct Sweep {
  std::vector<double> focals;  // In geometric steps, descending.
  std::vector<std::vector<double>> costs;

  double Total(std::size_t i) const {
    double total = 0;
    for (const std::vector<double>& pair : costs) total += pair[i];
    return total;
  }
  std::size_t Best() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < focals.size(); ++i) {
      if (Total(i) < Total(best)) best = i;
    }
    return best;
  }
  double LogStep() const { return std::log(focals[0] / focals[1]); }
};

std::vector<double> GeometricSteps(double first, double last, int count) {
  std::vector<double> steps;
  for (int i = 0; i < count; ++i)
    steps.push_back(first * std::pow(last / first, i / (count - 1.0)));
  return steps;
}

/// The minimum of the parabola through the costs around the best focal length of a fine sweep.
struct Peak {
  double focal = 0;
  double variance = std::numeric_limits<double>::infinity();  // Variance of log focal.
  double inflation = 1;  // Ratio of the variance to that caused by pixel noise.
};

/// Returns the peak of a sweep. Its variance is the larger of 2 / H, for a cost that is χ², and
/// Σ g² / H² over the slopes g of the pairs at the common minimum (White's sandwich), where H is
/// the second derivative.
Peak FindPeak(const Sweep& sweep) {
  const std::size_t best = sweep.Best();
  Peak peak{sweep.focals[best]};
  if (best == 0 || best + 1 == sweep.focals.size()) return peak;
  const double step = sweep.LogStep();
  double slope = 0, curvature = 0, squared_slopes = 0;
  for (const std::vector<double>& cost : sweep.costs) {
    const double bend = (cost[best - 1] + cost[best + 1] - 2 * cost[best]) / (step * step);
    slope += (cost[best + 1] - cost[best - 1]) / (2 * step);
    curvature += bend;
  }
  if (!(curvature > 0)) return peak;
  const double offset = std::clamp(-slope / curvature, -step, step);
  for (const std::vector<double>& cost : sweep.costs) {
    const double bend = (cost[best - 1] + cost[best + 1] - 2 * cost[best]) / (step * step);
    const double at_peak = (cost[best + 1] - cost[best - 1]) / (2 * step) + bend * offset;
    squared_slopes += at_peak * at_peak;
  }
  const double from_noise = 2 / curvature;
  peak.focal *= std::exp(-offset);
  peak.variance = std::max(from_noise, squared_slopes / (curvature * curvature));
  peak.inflation = peak.variance / from_noise;
  return peak;
}

/// Returns the variance of log focal around `focal` over the whole sweep, its costs taken as χ² of
/// pairs that are inconsistent by the factor `inflation`. Unlike the curvature, it reflects other
/// minima and flat sides.
double SpreadVariance(const Sweep& sweep, double focal, double inflation) {
  const double least = sweep.Total(sweep.Best());
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < sweep.focals.size(); ++i) {
    const double weight = std::exp(-0.5 * (sweep.Total(i) - least) / inflation);
    sum += weight * std::pow(std::log(sweep.focals[i] / focal), 2);
    weights += weight;
  }
  return sum / weights;
}

/// The coarse and the fine sweep over the focal lengths.
class FocalSearch {
 public:
  /// `pairs` must not be empty.
  FocalSearch(std::vector<Pair> pairs, const FocalSearchOptions& options)
      : pairs_(std::move(pairs)), options_(options) {
    std::vector<double> noises;
    for (const Pair& pair : pairs_) noises.push_back(pair.noise);
    constexpr double kMinNoise = 1e-3;  // For exact matches.
    noise_ = std::max(kMinNoise, Median(std::move(noises)));
  }

  void Run(FocalSearchResult& result) const {
    const double width = result.camera.width;
    const Sweep coarse = MakeSweep(FocalOfFov(options_.min_fov_deg, width),
                                   FocalOfFov(options_.max_fov_deg, width), options_.num_coarse);
    for (std::size_t i = 0; i < coarse.focals.size(); ++i) {
      result.sweep.push_back(MakeCandidate(coarse.focals[i], width, coarse.Total(i)));
    }
    const std::size_t best = coarse.Best();
    if (best == 0 || best + 1 == coarse.focals.size()) return;
    const Peak peak = FindPeak(
        MakeSweep(coarse.focals[best - 1], coarse.focals[best + 1], 2 * options_.num_fine + 1));
    const double spread = SpreadVariance(coarse, peak.focal, peak.inflation);
    const bool is_wide = spread > coarse.LogStep() * coarse.LogStep();
    result.focal_sigma = std::sqrt(peak.variance + (is_wide ? spread : 0));
    result.is_determined = result.focal_sigma < options_.max_sigma;
    if (result.focal_sigma < options_.useless_sigma) {
      result.camera.fx = result.camera.fy = peak.focal;
    }
  }

 private:
  Sweep MakeSweep(double longest, double shortest, int count) const {
    Sweep sweep{GeometricSteps(longest, shortest, count), {}};
    for (const Pair& pair : pairs_) {
      sweep.costs.push_back(PairCosts(pair, sweep.focals, noise_, options_.max_rotation_excess));
    }
    return sweep;
  }

  std::vector<Pair> pairs_;
  const FocalSearchOptions& options_;
  double noise_ = 1;  // Median of the pairs' noises.
};

}  // namespace

void FocalSearchOptions::Validate() const {
  CheckFields("focal_search", *this);
  CheckRange("focal_search.max_fov_deg", max_fov_deg, min_fov_deg + 1, 170.0);
}

FocalSearchResult SearchFocal(const std::vector<PixelMatches>& pairs, int width, int height,
                              const FocalSearchOptions& options) {
  options.Validate();
  FocalSearchResult result;
  result.camera = CenteredPinhole(FocalOfFov(options.unknown_fov_deg, width), width, height);
  result.camera.Validate();
  const Eigen::Vector2d center(result.camera.cx, result.camera.cy);
  std::vector<Pair> usable;
  for (const PixelMatches& matches : pairs) {
    if (std::optional<Pair> pair = MakePair(matches, center, options)) {
      usable.push_back(std::move(*pair));
    }
  }
  result.num_pairs = static_cast<int>(usable.size());
  if (!usable.empty()) FocalSearch(std::move(usable), options).Run(result);
  return result;
}

}  // namespace corvo
