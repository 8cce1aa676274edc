#include "vo/bundle_calibrator.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "orb/error.h"
#include "vo/bundle_problem.h"
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

ceres::CostFunction* MakePrior(const Eigen::Vector3d& sigmas) {
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
  problem.AddResidualBlock(MakePrior(PriorSigmas(options)), nullptr, calibration.data());
  FixGauge(bundle, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options.max_iterations), &problem, &summary);
  return summary.IsSolutionUsable();
}

using PoseJacobian = Eigen::Matrix<double, 2, 6>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// Derivatives of a sighting's error, in units of sigma.
struct Linearized {
  int view;
  PoseJacobian by_pose;
  Matrix23 by_point;
  Matrix23 by_calibration;
};

std::optional<Linearized> Linearize(const Camera& camera, const SE3& camera_from_local,
                                    const Eigen::Vector3d& in_local,
                                    const Bundle::Sighting& sighting) {
  const Eigen::Vector3d in_camera = camera_from_local * in_local;
  Camera::Jacobian by_camera_point;
  const auto pixel = camera.Project(in_camera, &by_camera_point);
  if (!pixel) return std::nullopt;
  by_camera_point /= sighting.sigma_px;
  Linearized linearized;
  linearized.view = sighting.view;
  linearized.by_pose << -by_camera_point, by_camera_point * SO3::Hat(in_camera);
  linearized.by_point = by_camera_point * camera_from_local.rotation().matrix();
  linearized.by_calibration =
      PixelByCalibration(camera.parameters(), in_camera.hnormalized(), *pixel) / sighting.sigma_px;
  return linearized;
}

/// Information about poses (six numbers a view) and calibration (the last three), the points
/// eliminated by Schur complement.
class ReducedInformation {
 public:
  explicit ReducedInformation(int num_views)
      : calibration_(6 * num_views), matrix_(6 * num_views + 3, 6 * num_views + 3) {
    matrix_.setZero();
  }

  /// The sightings of one point.
  void AddPoint(const std::vector<Linearized>& sightings) {
    Eigen::Matrix3d point = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d calibration_point = Eigen::Matrix3d::Zero();
    for (const Linearized& s : sightings) {
      point += s.by_point.transpose() * s.by_point;
      calibration_point += s.by_calibration.transpose() * s.by_point;
    }
    if (point.determinant() < 1e-12) return;
    const Eigen::Matrix3d covariance = point.inverse();
    for (const Linearized& a : sightings) {
      const Eigen::Matrix<double, 6, 3> gain = a.by_pose.transpose() * a.by_point * covariance;
      Block(a.view, a.view) += a.by_pose.transpose() * a.by_pose;
      for (const Linearized& b : sightings) {
        Block(a.view, b.view) -= gain * (b.by_point.transpose() * b.by_pose);
      }
      matrix_.block<6, 3>(6 * a.view, calibration_) +=
          a.by_pose.transpose() * a.by_calibration - gain * calibration_point.transpose();
      matrix_.bottomRightCorner<3, 3>() += a.by_calibration.transpose() * a.by_calibration;
    }
    matrix_.bottomRightCorner<3, 3>() -=
        calibration_point * covariance * calibration_point.transpose();
  }

  /// Of the calibration, given its prior; held views are known exactly.
  Eigen::Matrix3d CalibrationCovariance(const Eigen::Vector3d& prior_sigmas,
                                        const std::vector<Bundle::View>& views) {
    constexpr double kHeld = 1e12, kGauge = 1e-3;
    matrix_.block(calibration_, 0, 3, calibration_) =
        matrix_.block(0, calibration_, calibration_, 3).transpose();
    for (int view = 0; view < static_cast<int>(views.size()); ++view) {
      const bool is_known = views[view].is_held || view == 0;
      Block(view, view).diagonal().array() += is_known ? kHeld : kGauge;
    }
    matrix_.bottomRightCorner<3, 3>().diagonal() += prior_sigmas.cwiseInverse().cwiseAbs2();
    Eigen::MatrixXd selected = Eigen::MatrixXd::Zero(matrix_.rows(), 3);
    selected.bottomRows<3>().setIdentity();
    return matrix_.ldlt().solve(selected).bottomRows<3>();
  }

 private:
  Eigen::Block<Eigen::MatrixXd, 6, 6> Block(int row, int column) {
    return matrix_.block<6, 6>(6 * row, 6 * column);
  }

  int calibration_;
  Eigen::MatrixXd matrix_;
};

/// From the selected points.
Eigen::Matrix3d ComputeCovariance(const Camera& camera, const Eigen::Vector3d& prior_sigmas,
                                  const std::vector<char>& is_selected, const Bundle& bundle) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  ReducedInformation information(static_cast<int>(bundle.views.size()));
  std::vector<Linearized> of_point;
  for (std::size_t i = 0; i < bundle.sightings.size(); ++i) {
    const Bundle::Sighting& sighting = bundle.sightings[i];
    const auto linearized = Linearize(camera, camera_from_local[sighting.view],
                                      bundle.points[sighting.point].in_local, sighting);
    if (sighting.is_inlier && linearized) of_point.push_back(*linearized);
    const bool is_last =
        i + 1 == bundle.sightings.size() || bundle.sightings[i + 1].point != sighting.point;
    if (!is_last) continue;
    if (of_point.size() > 1 && is_selected[sighting.point]) information.AddPoint(of_point);
    of_point.clear();
  }
  return information.CalibrationCovariance(prior_sigmas, bundle.views);
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
  estimate.covariance = ComputeCovariance(camera, PriorSigmas(options), is_selected, bundle);
  return estimate;
}

}  // namespace corvo
