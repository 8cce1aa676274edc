// SPDX-License-Identifier: MIT
#include "vo/optimization/keyframe_innovations.h"

#include <Eigen/Cholesky>

namespace corvo {
namespace {

constexpr int kMinLater = 3;  // Keyframes that show how an innovation moves what follows.

/// Returns a lower triangular matrix L: Σ = L Lᵀ up to rounding, which is raised until the matrix
/// is positive definite.
Eigen::MatrixXd FactorOf(const Eigen::MatrixXd& covariance) {
  for (double rounding = 1e-12; rounding < 1; rounding *= 10) {
    Eigen::MatrixXd raised = covariance;
    raised.diagonal() *= 1 + rounding;
    const Eigen::LLT<Eigen::MatrixXd> solver(raised);
    if (solver.info() == Eigen::Success) return solver.matrixL();
  }
  return covariance.diagonal().cwiseSqrt().asDiagonal();
}

/// Returns L⁻¹ G.
Eigen::MatrixXd Whiten(const Eigen::MatrixXd& factor, const Eigen::MatrixXd& by_camera) {
  // A block of a matrix without columns would be at an offset from a null pointer.
  if (by_camera.cols() == 0) return by_camera;
  return factor.triangularView<Eigen::Lower>().solve(by_camera);
}

}  // namespace

KeyframeInnovations::KeyframeInnovations(const KeyframeCovariance& covariance,
                                         const std::vector<SE3>& world_from_keyframe)
    : poses_(world_from_keyframe),
      factor_(FactorOf(covariance.matrix)),
      whitened_(Whiten(factor_, covariance.by_camera)),
      by_scale_(Eigen::RowVectorXd::Zero(covariance.matrix.cols())) {
  for (int position = 0; KnowsScale(position); ++position) {
    by_scale_.segment<6>(6 * position) = FitScale(position);
  }
}

bool KeyframeInnovations::KnowsScale(int position) const {
  return position + kMinLater < static_cast<int>(poses_.size());
}

KeyframeInnovations::Matrix7X KeyframeInnovations::ByInnovations(int first, int second) const {
  const SE3::Matrix6 adjoint = (poses_[second].Inverse() * poses_[first]).Adjoint();
  Matrix7X error = Matrix7X::Zero(7, factor_.cols());
  error.topRows<6>() =
      factor_.middleRows<6>(6 * second) - adjoint * factor_.middleRows<6>(6 * first);
  const int begin = 6 * (first + 1), size = 6 * (second - first);
  error.row(6).segment(begin, size) = by_scale_.segment(begin, size);
  return error;
}

Eigen::Matrix<double, 1, 6> KeyframeInnovations::FitScale(int position) const {
  using Row6 = Eigen::Matrix<double, 1, 6>;
  const int size = static_cast<int>(poses_.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = position + 1; i < size; ++i) mean += poses_[i].translation() / (size - position - 1);
  // A rotation moves all positions perpendicularly to their arms, and the arms sum up to zero.
  Row6 sum = Row6::Zero();
  double spread = 0;
  for (int i = position + 1; i < size; ++i) {
    const Eigen::Vector3d arm = poses_[i].translation() - mean;
    const Eigen::Matrix3d rotation = poses_[i].rotation().matrix();
    sum += arm.transpose() * rotation * factor_.block<3, 6>(6 * i, 6 * position);
    spread += arm.squaredNorm();
  }
  return spread > 0 ? Row6(sum / spread) : Row6(Row6::Zero());
}

}  // namespace corvo
