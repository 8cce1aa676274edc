#include "vo/full_adjustment.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include "orb/error.h"
#include "vo/bundle_problem.h"
#include "vo/camera_covariance.h"
#include "vo/chi_square.h"
#include "vo/differentiable_camera.h"
#include "vo/pose_optimizer.h"
#include "vo/reprojection_cost.h"

namespace corvo {
namespace {

constexpr double kUnseenError = 1e3;  // Of a sighting that does not project, in units of sigma.
constexpr int kRounds = 2;
constexpr int kMaxDenseViews = 300;  // Dense algebra is faster up to about here.

/// The camera under adjustment, made anew before each evaluation.
class AdjustedCamera : public ceres::EvaluationCallback {
 public:
  AdjustedCamera(const CameraPrior& prior, const Eigen::VectorXd& difference)
      : prior_(prior), difference_(difference) {}

  void PrepareForEvaluation(bool, bool new_point) override {
    if (!new_point && camera_) return;
    try {
      camera_.emplace(prior_, difference_);
    } catch (const Error&) {
      camera_.reset();
    }
  }

  /// Null where the difference is no camera's: a step too far, which the solver takes back.
  const DifferentiableCamera* camera() const { return camera_ ? &*camera_ : nullptr; }

 private:
  const CameraPrior& prior_;
  const Eigen::VectorXd& difference_;
  std::optional<DifferentiableCamera> camera_;
};

/// ReprojectionCost whose third parameter, where there is any, is the camera's difference. A point
/// that does not project has a large error, and no derivative.
class SightingCost : public ceres::CostFunction {
 public:
  SightingCost(const AdjustedCamera& adjusted, int num_free, const Bundle::Sighting& sighting)
      : adjusted_(adjusted), pixel_(sighting.pixel), sigma_px_(sighting.sigma_px) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {7, 3};
    if (num_free > 0) mutable_parameter_block_sizes()->push_back(num_free);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    if (adjusted_.camera() == nullptr) return false;
    const ReprojectionCost cost(adjusted_.camera()->camera(), pixel_, sigma_px_);
    if (!cost.Evaluate(parameters, residuals, jacobians)) {
      SetUnseen(residuals, jacobians);
    } else if (jacobians != nullptr && parameter_block_sizes().size() == 3 &&
               jacobians[2] != nullptr) {
      DifferentiateByCamera(parameters, residuals, jacobians[2]);
    }
    return true;
  }

 private:
  void SetUnseen(double* residuals, double** jacobians) const {
    residuals[0] = kUnseenError;
    residuals[1] = 0;
    if (jacobians == nullptr) return;
    for (std::size_t i = 0; i < parameter_block_sizes().size(); ++i) {
      if (jacobians[i] != nullptr) std::fill_n(jacobians[i], 2 * parameter_block_sizes()[i], 0.0);
    }
  }

  void DifferentiateByCamera(const double* const* parameters, const double* residuals,
                             double* jacobian) const {
    const SE3 local_from_camera = SE3::FromData(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> in_local(parameters[1]);
    const Eigen::Vector2d seen = pixel_ + sigma_px_ * Eigen::Map<const Eigen::Vector2d>(residuals);
    using RowMajor = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor>{jacobian, 2, parameter_block_sizes()[2]} =
        adjusted_.camera()->PixelByDifference(local_from_camera.Inverse() * in_local, seen) /
        sigma_px_;
  }

  const AdjustedCamera& adjusted_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

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

ceres::CostFunction* MakePrior(const CameraPrior& prior) {
  Eigen::VectorXd weights(prior.num_free());
  for (int i = 0; i < prior.num_free(); ++i) weights[i] = 1 / prior.free[i].sigma;
  return new ceres::NormalPrior(weights.asDiagonal().toDenseMatrix(),
                                Eigen::VectorXd::Zero(prior.num_free()));
}

void AddSightings(const AdjustedCamera& adjusted, ceres::LossFunction* loss, Parameters& parameters,
                  ceres::Problem& problem) {
  const int num_free = static_cast<int>(parameters.difference.size());
  Eigen::Vector3d* points = parameters.points.data();
  for (Bundle& bundle : parameters.bundles) {
    for (const Bundle::Sighting& sighting : bundle.sightings) {
      if (!sighting.is_inlier) continue;
      std::vector<double*> blocks{bundle.views[sighting.view].local_from_camera.data(),
                                  points[sighting.point].data()};
      if (num_free > 0) blocks.push_back(parameters.difference.data());
      problem.AddResidualBlock(new SightingCost(adjusted, num_free, sighting), loss, blocks);
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
  ProgressCallback(int round, int max_iterations, const std::function<void(double)>& progress)
      : round_(round), max_iterations_(max_iterations), progress_(progress) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const double share_of_round = static_cast<double>(summary.iteration) / max_iterations_;
    if (progress_) progress_((round_ + std::min(1.0, share_of_round)) / kRounds);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  int round_;
  int max_iterations_;
  const std::function<void(double)>& progress_;
};

bool Solve(const CameraPrior& prior, const FullAdjustmentOptions& options,
           ProgressCallback& progress, Parameters& parameters) {
  AdjustedCamera adjusted(prior, parameters.difference);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.evaluation_callback = &adjusted;
  ceres::HuberLoss huber(std::sqrt(kChiSquare2Dof95));
  ceres::Problem problem(problem_options);
  AddSightings(adjusted, &huber, parameters, problem);
  if (prior.num_free() > 0) {
    problem.AddResidualBlock(MakePrior(prior), nullptr, parameters.difference.data());
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

double HuberLoss(double squared_error) {
  if (squared_error <= kChiSquare2Dof95) return squared_error;
  return 2 * std::sqrt(kChiSquare2Dof95 * squared_error) - kChiSquare2Dof95;
}

/// Calls `visit` with every sighting and its squared error, in units of sigma².
void ForEachError(const Camera& camera, std::vector<Bundle>& bundles,
                  const std::function<void(Bundle::Sighting&, double)>& visit) {
  for (Bundle& bundle : bundles) {
    std::vector<SE3> camera_from_local;
    for (const Bundle::View& view : bundle.views) {
      camera_from_local.push_back(view.Pose().Inverse());
    }
    for (Bundle::Sighting& sighting : bundle.sightings) {
      const PointObservation observation{bundle.points[sighting.point].in_local, sighting.pixel,
                                         sighting.sigma_px};
      const double error = SquaredError(observation, camera_from_local[sighting.view], camera);
      visit(sighting, std::min(error, kUnseenError * kUnseenError));
    }
  }
}

double RobustCost(const CameraPrior& prior, const Eigen::VectorXd& difference,
                  std::vector<Bundle>& bundles) {
  double sum = prior.SquaredError(difference);
  ForEachError(Camera(prior.Apply(difference)), bundles,
               [&](const Bundle::Sighting&, double error) { sum += HuberLoss(error); });
  return 0.5 * sum;
}

void SetInliers(const Camera& camera, double max_squared_error, std::vector<Bundle>& bundles) {
  ForEachError(camera, bundles, [&](Bundle::Sighting& sighting, double error) {
    sighting.is_inlier = error <= max_squared_error;
  });
}

/// Adjusts in two rounds; returns whether that led to a camera.
bool SolveInRounds(const CameraPrior& prior, const FullAdjustmentOptions& options,
                   const std::function<void(double)>& progress, Parameters& parameters) {
  constexpr double kGrossError = 5 * 5;
  for (Bundle& bundle : parameters.bundles) {
    for (Bundle::Sighting& sighting : bundle.sightings) sighting.is_inlier = true;
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
  result.outcome = AdjustmentOutcome::kLowered;
  result.camera = prior.Apply(difference);
  double sum_px = 0;
  ForEachError(Camera(result.camera), bundles, [&](Bundle::Sighting& sighting, double error) {
    sighting.is_inlier = error <= kChiSquare2Dof95;
    if (!sighting.is_inlier) return;
    ++result.num_inliers;
    sum_px += error * sighting.sigma_px * sighting.sigma_px;
  });
  result.inlier_rms_px = std::sqrt(sum_px / std::max(1, result.num_inliers));
  result.covariance = CameraCovariance(prior, difference, bundles);
}

}  // namespace

FullAdjustment AdjustFully(const CameraPrior& prior, const CameraParameters& start,
                           const FullAdjustmentOptions& options, std::vector<Bundle>& bundles,
                           const std::function<void(double)>& progress) {
  prior.Validate();
  const std::vector<Bundle> before = bundles;
  Parameters parameters(bundles);
  parameters.difference = prior.Difference(start);
  FullAdjustment result;
  result.camera = start;
  for (const Bundle& bundle : bundles) {
    result.num_sightings += static_cast<int>(bundle.sightings.size());
  }
  if (result.num_sightings == 0) return result;
  result.outcome = AdjustmentOutcome::kSolverFailed;
  result.initial_cost = RobustCost(prior, parameters.difference, bundles);
  if (std::isfinite(result.initial_cost) && SolveInRounds(prior, options, progress, parameters)) {
    result.final_cost = RobustCost(prior, parameters.difference, bundles);
    result.outcome = AdjustmentOutcome::kNotLowered;
    if (result.final_cost < result.initial_cost) {
      Account(prior, parameters.difference, bundles, result);
    }
  }
  if (result.outcome != AdjustmentOutcome::kLowered) bundles = before;
  return result;
}

Bundle ThinPoints(const Bundle& bundle, int max_points) {
  std::vector<std::vector<int>> sightings_of(bundle.points.size());
  for (std::size_t i = 0; i < bundle.sightings.size(); ++i) {
    sightings_of[bundle.sightings[i].point].push_back(static_cast<int>(i));
  }
  std::vector<int> order(bundle.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sightings_of[a].size() > sightings_of[b].size(); });
  std::vector<int> num_kept(bundle.views.size(), 0);
  std::vector<char> is_kept(bundle.points.size(), 0);
  for (const int point : order) {
    const std::vector<int>& seen = sightings_of[point];
    const auto has_room = [&](int i) { return num_kept[bundle.sightings[i].view] < max_points; };
    if (seen.size() < 2 || std::none_of(seen.begin(), seen.end(), has_room)) continue;
    is_kept[point] = 1;
    for (const int i : seen) ++num_kept[bundle.sightings[i].view];
  }
  Bundle thinned{bundle.world_from_local, bundle.views, {}, {}};
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (!is_kept[point]) continue;
    for (const int i : sightings_of[point]) {
      thinned.sightings.push_back(bundle.sightings[i]);
      thinned.sightings.back().point = static_cast<int>(thinned.points.size());
    }
    thinned.points.push_back(bundle.points[point]);
  }
  return thinned;
}

}  // namespace corvo
