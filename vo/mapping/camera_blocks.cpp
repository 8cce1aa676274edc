// SPDX-License-Identifier: MIT
#include "vo/mapping/camera_blocks.h"

#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

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
  CameraEstimate estimate{Difference(sum), covariance};
  const int degrees_of_freedom = (size() - 1) * prior_.num_free();
  const double chi_square = ChiSquare(estimate.difference);
  if (degrees_of_freedom > 0 && chi_square > ChiSquare999(degrees_of_freedom)) {
    estimate.covariance *= chi_square / degrees_of_freedom;
    estimate.is_consistent = false;
  }
  return estimate;
}

Eigen::VectorXd CameraBlocks::Difference(const CameraInformation& sum) const {
  constexpr double kVeryStrong = 5;
  std::vector<int> all(prior_.num_free());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> some = prior_.IndicesWithoutEvidence();
  const bool is_evident =
      some.size() < all.size() && LogLikelihood(sum, all) > LogLikelihood(sum, some) + kVeryStrong;
  const std::vector<int>& free = is_evident ? all : some;
  const Eigen::MatrixXd information = sum.matrix + PriorInformation(prior_);
  const Eigen::MatrixXd of_free = information(free, free);
  const Eigen::VectorXd vector = sum.vector(free);
  const Eigen::VectorXd of_free_only = of_free.ldlt().solve(vector);
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(prior_.num_free());
  difference(free) = of_free_only;
  return difference;
}

double CameraBlocks::LogLikelihood(const CameraInformation& sum,
                                   const std::vector<int>& free) const {
  const Eigen::MatrixXd prior = PriorInformation(prior_)(free, free);
  const Eigen::MatrixXd information = prior + stated_share_ * sum.matrix(free, free);
  const Eigen::LLT<Eigen::MatrixXd> root(information);
  const Eigen::VectorXd vector = stated_share_ * sum.vector(free);
  const double log_root_determinant = root.matrixLLT().diagonal().array().log().sum();
  double log_prior = 0;  // Without parameters of which nothing is known; these are always free.
  for (const double value : prior.diagonal()) {
    if (value > 0) log_prior += std::log(value);
  }
  return 0.5 * vector.dot(root.solve(vector)) - log_root_determinant + 0.5 * log_prior;
}

double CameraBlocks::ChiSquare(const Eigen::VectorXd& difference) const {
  double sum = 0;
  for (const CameraInformation& block : blocks_) {
    sum += SquaredNorm(block.vector - block.matrix * difference, block.matrix);
  }
  return stated_share_ * sum;
}

}  // namespace corvo
