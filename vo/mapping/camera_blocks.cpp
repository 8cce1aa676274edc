// SPDX-License-Identifier: MIT
#include "vo/mapping/camera_blocks.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "vo/math/chi_square.h"
#include "vo/optimization/camera_covariance.h"

namespace corvo {
namespace {

/// Returns vᵀ M⁺ v for a positive semidefinite matrix M in the range of which v lies, up to errors
/// of rounding.
double SquaredNorm(const Eigen::VectorXd& v, const Eigen::MatrixXd& matrix) {
  constexpr double kSingular = 1e-12;  // Relative to the largest eigenvalue of the scaled matrix.
  const Eigen::VectorXd units = matrix.diagonal().cwiseSqrt().cwiseInverse();
  if (!units.allFinite()) return 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> scaled(units.asDiagonal() * matrix *
                                                              units.asDiagonal());
  const Eigen::VectorXd parts = scaled.eigenvectors().transpose() * units.cwiseProduct(v);
  double sum = 0;
  for (Eigen::Index i = 0; i < parts.size(); ++i) {
    const double eigenvalue = scaled.eigenvalues()[i];
    if (eigenvalue > kSingular) sum += parts[i] * parts[i] / eigenvalue;
  }
  return sum;
}

}  // namespace

CameraEstimate CameraBlocks::Estimate() const {
  if (blocks_.empty() || prior_.num_free() == 0) return PriorEstimate(prior_);
  CameraInformation sum = blocks_.front();
  for (int i = 1; i < size(); ++i) {
    sum.matrix += blocks_[i].matrix;
    sum.vector += blocks_[i].vector;
  }
  const Eigen::MatrixXd covariance = CameraCovariance(prior_, stated_share_ * sum.matrix);
  CameraEstimate estimate{(sum.matrix + PriorInformation(prior_)).ldlt().solve(sum.vector),
                          covariance};
  const int degrees_of_freedom = (size() - 1) * prior_.num_free();
  const double chi_square = ChiSquare(estimate.difference);
  if (degrees_of_freedom > 0 && chi_square > ChiSquare999(degrees_of_freedom)) {
    estimate.covariance *= chi_square / degrees_of_freedom;
    estimate.is_consistent = false;
  }
  return estimate;
}

double CameraBlocks::ChiSquare(const Eigen::VectorXd& difference) const {
  double sum = 0;
  for (const CameraInformation& block : blocks_) {
    sum += SquaredNorm(block.vector - block.matrix * difference, block.matrix);
  }
  return stated_share_ * sum;
}

}  // namespace corvo
