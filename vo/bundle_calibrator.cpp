#include "vo/bundle_calibrator.h"

#include <cmath>
#include <optional>

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include "orb/error.h"
#include "vo/bundle_problem.h"
#include "vo/camera_covariance.h"
#include "vo/chi_square.h"
#include "vo/point_adjuster.h"
#include "vo/point_selection.h"
#include "vo/reprojection_cost.h"

namespace corvo {
namespace {

/// The camera that a calibration under adjustment stands for: made anew before each evaluation.
class CameraUnderAdjustment : public ceres::EvaluationCallback {
 public:
  CameraUnderAdjustment(const CameraParameters& given, const Calibration& calibration)
      : given_(given), calibration_(calibration) {}

  void PrepareForEvaluation(bool, bool new_point) override {
    if (!new_point) return;
    try {
      camera_.emplace(ApplyCalibration(given_, calibration_));
    } catch (const Error&) {
      camera_.reset();
    }
  }

  /// Null where the calibration is no camera's: a step too far, which the solver takes back.
  const Camera* camera() const { return camera_ ? &*camera_ : nullptr; }

 private:
  const CameraParameters& given_;
  const Calibration& calibration_;
  std::optional<Camera> camera_;
};

/// ReprojectionCost with the calibration as its third parameter.
class CalibrationCost : public ceres::SizedCostFunction<2, 7, 3, 3> {
 public:
  CalibrationCost(const CameraUnderAdjustment& adjusted, const Bundle::Sighting& sighting)
      : adjusted_(adjusted), pixel_(sighting.pixel), sigma_px_(sighting.sigma_px) {}

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    if (adjusted_.camera() == nullptr) return false;
    const Camera& camera = *adjusted_.camera();
    if (!ReprojectionCost(camera, pixel_, sigma_px_).Evaluate(parameters, residuals, jacobians)) {
      return false;
    }
    if (jacobians == nullptr || jacobians[2] == nullptr) return true;
    const Eigen::Map<const Eigen::Quaterniond> rotation(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> translation(parameters[0] + 4);
    const Eigen::Map<const Eigen::Vector3d> in_world(parameters[1]);
    const Eigen::Vector2d normalized =
        (rotation.conjugate() * (in_world - translation)).hnormalized();
    const Eigen::Vector2d seen = pixel_ + sigma_px_ * Eigen::Map<Eigen::Vector2d>(residuals);
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{jacobians[2]} =
        PixelByCalibration(camera.parameters(), normalized, seen) / sigma_px_;
    return true;
  }

 private:
  const CameraUnderAdjustment& adjusted_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

ceres::CostFunction* MakePriorCost(const Eigen::Vector3d& sigmas) {
  return new ceres::NormalPrior(sigmas.cwiseInverse().asDiagonal().toDenseMatrix(),
                                Eigen::Vector3d::Zero());
}

bool Solve(const CameraParameters& given, const CalibrationOptions& options,
           const std::vector<char>& is_selected, Bundle& bundle, Calibration& calibration) {
  CameraUnderAdjustment adjusted(given, calibration);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.evaluation_callback = &adjusted;
  ceres::HuberLoss huber(std::sqrt(kChiSquare2Dof95));
  ceres::Problem problem(problem_options);
  for (const Bundle::Sighting& sighting : bundle.sightings) {
    if (!sighting.is_inlier || !is_selected[sighting.point]) continue;
    problem.AddResidualBlock(new CalibrationCost(adjusted, sighting), &huber,
                             bundle.views[sighting.view].local_from_camera.data(),
                             bundle.points[sighting.point].in_local.data(), calibration.data());
  }
  problem.AddResidualBlock(MakePriorCost(PriorSigmas(options)), nullptr, calibration.data());
  FixGauge(bundle, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options.max_iterations), &problem, &summary);
  return summary.IsSolutionUsable();
}

}  // namespace

std::optional<CalibrationEstimate> CalibrateBundle(const CameraParameters& given,
                                                   const Calibration& start,
                                                   const CalibrationOptions& options,
                                                   Bundle& bundle) {
  constexpr double kProjects = 1e12;
  const Bundle before = bundle;
  CalibrationEstimate estimate;
  estimate.calibration = start;
  MarkOutliers(Camera(ApplyCalibration(given, start)), kProjects, bundle);
  const std::vector<char> is_selected = SelectPoints(bundle, options.points_per_keyframe);
  if (!Solve(given, options, is_selected, bundle, estimate.calibration)) {
    bundle = before;
    return std::nullopt;
  }
  const Camera camera(ApplyCalibration(given, estimate.calibration));
  AdjustPoints(camera, is_selected, bundle);
  MarkOutliers(camera, kChiSquare2Dof95, bundle);
  Bundle told = bundle;  // By the selected points alone.
  for (Bundle::Sighting& sighting : told.sightings) {
    sighting.is_inlier = sighting.is_inlier && is_selected[sighting.point];
  }
  estimate.covariance = CameraCovariance(MakePrior(given, options), estimate.calibration, {told});
  return estimate;
}

}  // namespace corvo
