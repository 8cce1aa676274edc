#include "vo/optimization/bundle_calibrator.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <ceres/ceres.h>

#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/optimization/adjusted_camera.h"
#include "vo/optimization/bundle_problem.h"
#include "vo/optimization/camera_covariance.h"
#include "vo/optimization/point_adjuster.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

/// Fewer of each keyframe, the more there are: however many, an estimate takes about the same time.
int PointsPerKeyframe(const Bundle& bundle, const CalibrationOptions& options) {
  const auto num_moving = std::count_if(bundle.views.begin(), bundle.views.end(),
                                        [](const Bundle::View& view) { return !view.is_fixed; });
  const int share = options.max_points / std::max(1, static_cast<int>(num_moving));
  return std::min(options.points_per_keyframe, share);
}

bool Solve(const CameraPrior& prior, const CalibrationOptions& options,
           const std::vector<char>& is_selected, Bundle& bundle, Eigen::VectorXd& difference) {
  AdjustedCamera adjusted(prior, difference);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.evaluation_callback = &adjusted;
  ceres::HuberLoss huber(options.huber_sigmas);
  ceres::Problem problem(problem_options);
  for (const Bundle::Observation& observation : bundle.observations) {
    if (!observation.is_inlier || !is_selected[observation.point]) continue;
    problem.AddResidualBlock(MakeReprojectionCost(adjusted, observation), &huber,
                             bundle.views[observation.view].local_from_camera.data(),
                             bundle.points[observation.point].in_local.data(), difference.data());
  }
  problem.AddResidualBlock(MakePriorCost(prior), nullptr, difference.data());
  FixGauge(bundle, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options.max_iterations), &problem, &summary);
  return summary.IsSolutionUsable();
}

/// By the selected points alone.
Eigen::MatrixXd Covariance(const CameraPrior& prior, const Eigen::VectorXd& difference,
                           const std::vector<char>& is_selected, Bundle bundle) {
  for (Bundle::Observation& observation : bundle.observations) {
    observation.is_inlier = observation.is_inlier && is_selected[observation.point];
  }
  return CameraCovariance(prior, difference, {std::move(bundle)});
}

}  // namespace

std::optional<CameraEstimate> CalibrateBundle(const CameraPrior& prior,
                                              const Eigen::VectorXd& start,
                                              const CalibrationOptions& options, Bundle& bundle) {
  const double gross_error = options.gross_error_sigmas * options.gross_error_sigmas;
  const CameraPrior beside = prior.Inflated(options.information_factor);
  const Bundle before = bundle;
  CameraEstimate estimate{start, {}};
  MarkOutliers(Camera(prior.Apply(start)), gross_error, bundle);
  const std::vector<char> is_selected = SelectPoints(bundle, PointsPerKeyframe(bundle, options));
  if (!Solve(beside, options, is_selected, bundle, estimate.difference)) {
    bundle = before;
    return std::nullopt;
  }
  const Camera camera(prior.Apply(estimate.difference));
  AdjustPoints(camera, is_selected, bundle);
  MarkOutliers(camera, kChiSquare2Dof95, bundle);
  estimate.covariance =
      Covariance(beside, estimate.difference, is_selected, bundle) / options.information_factor;
  return estimate;
}

}  // namespace corvo
