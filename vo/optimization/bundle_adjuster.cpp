// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle_adjuster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "orb/error.h"
#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/optimization/bundle_problem.h"
#include "vo/optimization/camera_covariance.h"
#include "vo/optimization/point_adjuster.h"
#include "vo/optimization/point_selection.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

constexpr double kCostRounding = 1e-9;  // Per observation: costs that differ by less are equal.

double Square(double x) { return x * x; }

/// Reports the share of the iterations of all rounds that is done.
class ProgressCallback : public ceres::IterationCallback {
 public:
  ProgressCallback(const AdjustmentOptions& options, int round, const AdjustmentProgress& progress)
      : options_(options), round_(round), progress_(progress) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const double share_of_round = static_cast<double>(summary.iteration) / options_.max_iterations;
    const double share = (round_ + std::min(1.0, share_of_round)) / options_.num_rounds;
    return !progress_ || progress_(share) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  const AdjustmentOptions& options_;
  int round_;
  const AdjustmentProgress& progress_;
};

/// An adjustment in progress.
class Adjustment {
 public:
  Adjustment(const AdjustmentOptions& options, const CameraPrior& prior,
             const CameraParameters& start, std::vector<Bundle>& bundles)
      : options_(options),
        prior_(prior.Inflated(options.information_factor)),
        camera_(start),
        state_{bundles, {}, prior_.Difference(start)} {
    summary_.camera = start;
    for (const Bundle& bundle : bundles) {
      summary_.num_observations += static_cast<int>(bundle.observations.size());
      state_.is_joint.push_back(options.points_per_view > 0
                                    ? SelectPoints(bundle, options.points_per_view)
                                    : std::vector<char>(bundle.points.size(), 1));
    }
  }

  AdjustmentSummary Run(const AdjustmentProgress& progress) {
    summary_.status = AdjustmentStatus::kNoObservations;
    if (summary_.num_observations == 0) return summary_;
    summary_.initial_cost = Evaluate(Square(options_.max_initial_error_sigmas));
    summary_.status = AdjustmentStatus::kSolverFailed;
    if (!std::isfinite(summary_.initial_cost)) return summary_;
    for (int round = 0; round < options_.num_rounds; ++round) {
      if (!SolveRound(round, progress)) return summary_;
    }
    if (progress) progress(1);
    summary_.final_cost = Evaluate(kChiSquare2Dof95);
    const double rounding = kCostRounding * summary_.num_observations;
    if (!(summary_.final_cost <= summary_.initial_cost + rounding)) {
      summary_.status = AdjustmentStatus::kNotImproved;
    } else {
      SetSolution();
    }
    return summary_;
  }

 private:
  /// Minimizes the cost over the inliers. Returns whether the solution is usable.
  bool SolveRound(int round, const AdjustmentProgress& progress) {
    if (round > 0) Evaluate(Square(options_.max_error_sigmas));
    ProgressCallback callback(options_, round, progress);
    summary_.status = BundleProblem(prior_, options_, state_).Solve(callback);
    if (!summary_.is_usable()) return false;
    const std::optional<Camera> camera = Camera::Make(prior_.Apply(state_.difference));
    if (!camera) {
      summary_.status = AdjustmentStatus::kInvalidCamera;
      return false;
    }
    camera_ = *camera;
    const PointAdjustmentOptions point_options{options_.huber_sigmas, options_.point_iterations};
    for (std::size_t i = 0; i < state_.bundles.size(); ++i) {
      AdjustPoints(camera_, state_.is_joint[i], point_options, state_.bundles[i]);
    }
    return true;
  }

  /// Marks observations up to a squared error, in units of sigma², as inliers. Returns the robust
  /// cost of the joint points and the camera.
  double Evaluate(double max_squared_error) {
    double sum = prior_.SquaredError(state_.difference);
    double inlier_sum_px = 0;
    summary_.num_inliers = 0;
    for (std::size_t i = 0; i < state_.bundles.size(); ++i) {
      const std::vector<char>& is_joint = state_.is_joint[i];
      VisitErrors(camera_, state_.bundles[i], [&](Bundle::Observation& observation, double error) {
        if (is_joint[observation.point]) sum += RobustLoss(error);
        observation.is_inlier = error <= max_squared_error;
        if (!observation.is_inlier) return;
        ++summary_.num_inliers;
        inlier_sum_px += error * Square(observation.sigma_px);
      });
    }
    summary_.inlier_rms_px = std::sqrt(inlier_sum_px / std::max(1, summary_.num_inliers));
    return 0.5 * sum;
  }

  double RobustLoss(double squared_error) const {
    return HuberLoss(std::min(squared_error, Square(kUnprojectableError)),
                     Square(options_.huber_sigmas))
        .value;
  }

  void SetSolution() {
    summary_.camera = camera_.parameters();
    summary_.estimate.difference = state_.difference;
    summary_.estimate.covariance =
        CameraCovariance(prior_, ObservedInformation(prior_, state_).matrix) /
        options_.information_factor;
  }

  const AdjustmentOptions& options_;
  CameraPrior prior_;
  Camera camera_;
  AdjustmentState state_;
  AdjustmentSummary summary_;
};

}  // namespace

void AdjustmentOptions::Validate() const {
  constexpr int kMaxCount = 1'000'000;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CheckRange("adjustment.num_rounds", num_rounds, 0, kMaxCount);
  CheckRange("adjustment.max_iterations", max_iterations, 0, kMaxCount);
  CheckRange("adjustment.huber_sigmas", huber_sigmas, 1e-6, 1e6);
  CheckRange("adjustment.max_initial_error_sigmas", max_initial_error_sigmas, 0.0, kInfinity);
  CheckRange("adjustment.max_error_sigmas", max_error_sigmas, 0.0, kInfinity);
  CheckRange("adjustment.information_factor", information_factor, 1e-12, 1e12);
  CheckRange("adjustment.points_per_view", points_per_view, 0, kMaxCount);
  CheckRange("adjustment.point_iterations", point_iterations, 0, kMaxCount);
  CheckRange("adjustment.max_dense_views", max_dense_views, 0, kMaxCount);
}

AdjustmentOptions WindowAdjustment(const BundleAdjusterOptions& options) {
  AdjustmentOptions adjustment;
  adjustment.max_iterations = options.max_iterations;
  adjustment.huber_sigmas = options.huber_sigmas;
  adjustment.points_per_view = options.points_per_keyframe;
  adjustment.point_iterations = options.point_iterations;
  return adjustment;
}

AdjustmentOptions CalibrationAdjustment(const CalibrationOptions& options, int num_keyframes) {
  AdjustmentOptions adjustment;
  adjustment.max_iterations = options.max_iterations;
  adjustment.huber_sigmas = options.huber_sigmas;
  adjustment.max_initial_error_sigmas = options.gross_error_sigmas;
  adjustment.information_factor = options.information_factor;
  // An estimate takes about the same time for any number of keyframes.
  adjustment.points_per_view =
      std::min(options.points_per_keyframe, options.max_points / std::max(1, num_keyframes));
  return adjustment;
}

AdjustmentSummary BundleAdjuster::Adjust(const CameraPrior& prior, const CameraParameters& start,
                                         std::vector<Bundle>& bundles,
                                         const AdjustmentProgress& progress) const {
  prior.Validate();
  const std::vector<Bundle> before = bundles;
  const AdjustmentSummary summary = Adjustment(options_, prior, start, bundles).Run(progress);
  if (!summary.is_usable()) bundles = before;
  return summary;
}

AdjustmentSummary BundleAdjuster::Adjust(const Camera& camera, Bundle& bundle) const {
  std::vector<Bundle> bundles;
  bundles.push_back(std::move(bundle));
  const AdjustmentSummary summary = Adjust({camera.parameters(), {}}, camera.parameters(), bundles);
  bundle = std::move(bundles.front());
  return summary;
}

}  // namespace corvo
