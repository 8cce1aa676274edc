#include "vo/optimization/full_adjustment.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ceres/ceres.h>

#include "orb/error.h"
#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/optimization/adjusted_camera.h"
#include "vo/optimization/bundle_problem.h"
#include "vo/optimization/camera_covariance.h"
#include "vo/optimization/point_selection.h"
#include "vo/optimization/pose_optimizer.h"

namespace corvo {
namespace {

constexpr int kRounds = 2;
constexpr int kMaxDenseViews = 300;  // Dense algebra is faster up to about here.

/// What is adjusted. The points of all bundles lie in one array: their order of elimination is
/// that of their addresses.
struct Parameters {
  std::vector<Bundle>& bundles;
  std::vector<Eigen::Vector3d> points;
  Eigen::VectorXd difference;

  explicit Parameters(std::vector<Bundle>& all) : bundles(all) {
    for (const Bundle& bundle : bundles) {
      for (const Bundle::Point& point : bundle.points) points.push_back(point.in_local);
    }
  }

  std::size_t num_views() const {
    std::size_t num_views = 0;
    for (const Bundle& bundle : bundles) num_views += bundle.views.size();
    return num_views;
  }

  void WriteBack() {
    auto point = points.begin();
    for (Bundle& bundle : bundles) {
      for (Bundle::Point& own : bundle.points) own.in_local = *point++;
    }
  }
};

void AddObservations(const AdjustedCamera& adjusted, ceres::LossFunction* loss,
                     Parameters& parameters, ceres::Problem& problem) {
  Eigen::Vector3d* points = parameters.points.data();
  for (Bundle& bundle : parameters.bundles) {
    for (const Bundle::Observation& observation : bundle.observations) {
      if (!observation.is_inlier) continue;
      std::vector<double*> blocks{bundle.views[observation.view].local_from_camera.data(),
                                  points[observation.point].data()};
      if (adjusted.num_free() > 0) blocks.push_back(parameters.difference.data());
      problem.AddResidualBlock(MakeReprojectionCost(adjusted, observation), loss, blocks);
    }
    points += bundle.points.size();
  }
}

/// Points first, then the poses of one bundle after the other, the camera last.
std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrder(Parameters& parameters,
                                                                const ceres::Problem& problem) {
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](double* block, int group) {
    if (problem.HasParameterBlock(block)) order->AddElementToGroup(block, group);
  };
  for (Eigen::Vector3d& point : parameters.points) add(point.data(), 0);
  int group = 0;
  for (Bundle& bundle : parameters.bundles) {
    ++group;
    for (Bundle::View& view : bundle.views) add(view.local_from_camera.data(), group);
  }
  if (parameters.difference.size() > 0) add(parameters.difference.data(), group + 1);
  return order;
}

/// Tells what share of all rounds' iterations is done.
class ProgressCallback : public ceres::IterationCallback {
 public:
  ProgressCallback(int round, int max_iterations, const AdjustmentProgress& progress)
      : round_(round), max_iterations_(max_iterations), progress_(progress) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const double share_of_round = static_cast<double>(summary.iteration) / max_iterations_;
    const double share = (round_ + std::min(1.0, share_of_round)) / kRounds;
    return !progress_ || progress_(share) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  int round_;
  int max_iterations_;
  const AdjustmentProgress& progress_;
};

bool Solve(const CameraPrior& prior, const FullAdjustmentOptions& options,
           ProgressCallback& progress, Parameters& parameters) {
  AdjustedCamera adjusted(prior, parameters.difference);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.evaluation_callback = &adjusted;
  ceres::HuberLoss huber(options.huber_sigmas);
  ceres::Problem problem(problem_options);
  AddObservations(adjusted, &huber, parameters, problem);
  if (prior.num_free() > 0) {
    problem.AddResidualBlock(MakePriorCost(prior), nullptr, parameters.difference.data());
  }
  for (Bundle& bundle : parameters.bundles) FixGauge(bundle, problem);
  ceres::Solver::Options solver_options = SolverOptions(options.max_iterations);
  if (parameters.num_views() > kMaxDenseViews) {
    solver_options.linear_solver_type = ceres::SPARSE_SCHUR;
  }
  solver_options.linear_solver_ordering = EliminationOrder(parameters, problem);
  solver_options.callbacks.push_back(&progress);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, &problem, &summary);
  parameters.WriteBack();
  return summary.IsSolutionUsable();
}

/// Calls `visit` with every observation and its squared error, in units of sigma².
void ForEachError(const Camera& camera, std::vector<Bundle>& bundles,
                  const std::function<void(Bundle::Observation&, double)>& visit) {
  for (Bundle& bundle : bundles) {
    const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
    for (Bundle::Observation& observation : bundle.observations) {
      const PointObservation point{bundle.points[observation.point].in_local, observation.pixel,
                                   observation.sigma_px};
      const double error = SquaredError(point, camera_from_local[observation.view], camera);
      visit(observation, std::min(error, kUnseenError * kUnseenError));
    }
  }
}

double RobustCost(const CameraPrior& prior, const Eigen::VectorXd& difference, double huber_sigmas,
                  std::vector<Bundle>& bundles) {
  double sum = prior.SquaredError(difference);
  ForEachError(Camera(prior.Apply(difference)), bundles,
               [&](const Bundle::Observation&, double error) {
                 sum += HuberLoss(error, huber_sigmas * huber_sigmas).value;
               });
  return 0.5 * sum;
}

void SetInliers(const Camera& camera, double max_squared_error, std::vector<Bundle>& bundles) {
  ForEachError(camera, bundles, [&](Bundle::Observation& observation, double error) {
    observation.is_inlier = error <= max_squared_error;
  });
}

/// Adjusts in two rounds; returns whether that led to a camera.
bool SolveInRounds(const CameraPrior& prior, const FullAdjustmentOptions& options,
                   const AdjustmentProgress& progress, Parameters& parameters) {
  constexpr double kGrossError = 5 * 5;
  for (Bundle& bundle : parameters.bundles) {
    for (Bundle::Observation& observation : bundle.observations) observation.is_inlier = true;
  }
  for (int round = 0; round < kRounds; ++round) {
    ProgressCallback callback(round, options.max_iterations, progress);
    if (!Solve(prior, options, callback, parameters)) return false;
    try {
      SetInliers(Camera(prior.Apply(parameters.difference)), kGrossError, parameters.bundles);
    } catch (const Error&) {
      return false;
    }
  }
  if (progress) progress(1);
  return true;
}

/// Marks the outliers of a solution and tells its figures.
void Account(const CameraPrior& prior, const Eigen::VectorXd& difference,
             std::vector<Bundle>& bundles, FullAdjustment& result) {
  result.outcome = AdjustmentOutcome::kImproved;
  result.camera = prior.Apply(difference);
  double sum_px = 0;
  ForEachError(Camera(result.camera), bundles, [&](Bundle::Observation& observation, double error) {
    observation.is_inlier = error <= kChiSquare2Dof95;
    if (!observation.is_inlier) return;
    ++result.num_inliers;
    sum_px += error * observation.sigma_px * observation.sigma_px;
  });
  result.inlier_rms_px = std::sqrt(sum_px / std::max(1, result.num_inliers));
  result.covariance = CameraCovariance(prior, difference, bundles);
}

}  // namespace

FullAdjustment AdjustFully(const CameraPrior& camera_prior, const CameraParameters& start,
                           const FullAdjustmentOptions& options, std::vector<Bundle>& bundles,
                           const AdjustmentProgress& progress) {
  camera_prior.Validate();
  const CameraPrior prior = camera_prior.Inflated(options.information_factor);
  const std::vector<Bundle> before = bundles;
  Parameters parameters(bundles);
  parameters.difference = prior.Difference(start);
  FullAdjustment result;
  result.camera = start;
  for (const Bundle& bundle : bundles) {
    result.num_observations += static_cast<int>(bundle.observations.size());
  }
  if (result.num_observations == 0) return result;
  result.outcome = AdjustmentOutcome::kSolverFailed;
  result.initial_cost = RobustCost(prior, parameters.difference, options.huber_sigmas, bundles);
  if (std::isfinite(result.initial_cost) && SolveInRounds(prior, options, progress, parameters)) {
    result.final_cost = RobustCost(prior, parameters.difference, options.huber_sigmas, bundles);
    result.outcome = AdjustmentOutcome::kNotImproved;
    if (result.final_cost < result.initial_cost) {
      Account(prior, parameters.difference, bundles, result);
      result.covariance /= options.information_factor;
    }
  }
  if (result.outcome != AdjustmentOutcome::kImproved) bundles = before;
  return result;
}

Bundle ThinPoints(const Bundle& bundle, int max_points) {
  const std::vector<int> begin = ObservationOffsets(bundle);
  const std::vector<char> is_selected = SelectPoints(bundle, max_points);
  Bundle thinned{bundle.world_from_local, bundle.views, {}, {}};
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (!is_selected[point] || begin[point + 1] - begin[point] < 2) continue;
    for (int i = begin[point]; i < begin[point + 1]; ++i) {
      thinned.observations.push_back(bundle.observations[i]);
      thinned.observations.back().point = static_cast<int>(thinned.points.size());
    }
    thinned.points.push_back(bundle.points[point]);
  }
  return thinned;
}

}  // namespace corvo
