#include "vo/optimization/adjusted_camera.h"

#include <algorithm>

#include <ceres/normal_prior.h>

#include "orb/error.h"
#include "vo/optimization/reprojection_cost.h"

namespace corvo {
namespace {

class CalibrationCost : public ceres::CostFunction {
 public:
  CalibrationCost(const AdjustedCamera& adjusted, const Bundle::Observation& observation)
      : adjusted_(adjusted), pixel_(observation.pixel), sigma_px_(observation.sigma_px) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {7, 3};
    if (adjusted.num_free() > 0) mutable_parameter_block_sizes()->push_back(adjusted.num_free());
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    if (adjusted_.camera() == nullptr) return false;
    const ReprojectionCost cost(adjusted_.camera()->camera(), pixel_, sigma_px_);
    if (!cost.Evaluate(parameters, residuals, jacobians)) {
      SetUnseen(residuals, jacobians);
    } else if (jacobians != nullptr && adjusted_.num_free() > 0 && jacobians[2] != nullptr) {
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
    Eigen::Map<RowMajor>{jacobian, 2, adjusted_.num_free()} =
        adjusted_.camera()->PixelByDifference(local_from_camera.Inverse() * in_local, seen) /
        sigma_px_;
  }

  const AdjustedCamera& adjusted_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

}  // namespace

void AdjustedCamera::PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) {
  if (!new_evaluation_point && camera_) return;
  try {
    camera_.emplace(prior_, difference_);
  } catch (const Error&) {
    camera_.reset();
  }
}

ceres::CostFunction* MakeReprojectionCost(const AdjustedCamera& adjusted,
                                          const Bundle::Observation& observation) {
  return new CalibrationCost(adjusted, observation);
}

ceres::CostFunction* MakePriorCost(const CameraPrior& prior) {
  Eigen::VectorXd weights(prior.num_free());
  for (int i = 0; i < prior.num_free(); ++i) weights[i] = 1 / prior.free[i].sigma;
  return new ceres::NormalPrior(weights.asDiagonal().toDenseMatrix(),
                                Eigen::VectorXd::Zero(prior.num_free()));
}

}  // namespace corvo
