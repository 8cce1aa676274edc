// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_covariance.h"

#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "vo/camera/differentiable_camera.h"

namespace corvo {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The derivatives of an observation's error, in units of sigma.
struct Linearized {
  int view;
  Eigen::Matrix<double, 2, 6> by_pose;
  Eigen::Matrix<double, 2, 3> by_point;
  DifferentiableCamera::Jacobian by_camera;
};

std::optional<Linearized> Linearize(const DifferentiableCamera& adjusted,
                                    const SE3& camera_from_local, const Eigen::Vector3d& in_local,
                                    const Bundle::Observation& observation) {
  const Eigen::Vector3d in_camera = camera_from_local * in_local;
  Camera::Jacobian by_camera_point;
  const auto pixel = adjusted.camera().Project(in_camera, &by_camera_point);
  if (!pixel) return std::nullopt;
  by_camera_point /= observation.sigma_px;
  Linearized linearized;
  linearized.view = observation.view;
  linearized.by_pose << -by_camera_point, by_camera_point * SO3::Hat(in_camera);
  linearized.by_point = by_camera_point * camera_from_local.rotation().matrix();
  linearized.by_camera = adjusted.PixelByDifference(in_camera, *pixel) / observation.sigma_px;
  return linearized;
}

/// The information of one bundle about its poses (six parameters for each view) and the camera,
/// with its points eliminated.
class ReducedInformation {
 public:
  ReducedInformation(int num_views, int num_free)
      : pose_camera_(Eigen::MatrixXd::Zero(6 * num_views, num_free)),
        camera_(Eigen::MatrixXd::Zero(num_free, num_free)) {}

  /// Adds the observations of one point.
  void AddPoint(const std::vector<Linearized>& observations) {
    Eigen::Matrix3d point = Eigen::Matrix3d::Zero();
    Eigen::MatrixXd camera_point = Eigen::MatrixXd::Zero(camera_.rows(), 3);
    for (const Linearized& s : observations) {
      point += s.by_point.transpose() * s.by_point;
      camera_point += s.by_camera.transpose() * s.by_point;
    }
    if (point.determinant() < 1e-12) return;
    const Eigen::Matrix3d covariance = point.inverse();
    for (const Linearized& a : observations) {
      const Eigen::Matrix<double, 6, 3> gain = a.by_pose.transpose() * a.by_point * covariance;
      Block(a.view, a.view) += a.by_pose.transpose() * a.by_pose;
      for (const Linearized& b : observations) {
        if (b.view <= a.view) {
          Block(a.view, b.view) -= gain * (b.by_point.transpose() * b.by_pose);
        }
      }
      pose_camera_.middleRows<6>(6 * a.view) +=
          a.by_pose.transpose() * a.by_camera - gain * camera_point.transpose();
      camera_ += a.by_camera.transpose() * a.by_camera;
    }
    camera_ -= camera_point * covariance * camera_point.transpose();
  }

  /// Returns the information about the camera, with the poses marginalized.
  Eigen::MatrixXd MarginalizePoses(const std::vector<Bundle::View>& views) {
    constexpr double kFixed = 1e12, kGauge = 1e-3;
    for (int view = 0; view < static_cast<int>(views.size()); ++view) {
      const bool is_known = views[view].is_fixed || view == 0;
      Block(view, view).diagonal().array() += is_known ? kFixed : kGauge;
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> poses(PoseMatrix());
    return camera_ - pose_camera_.transpose() * poses.solve(pose_camera_);
  }

 private:
  /// Returns a block of the lower triangle of the poses' information.
  Matrix6d& Block(int row, int column) {
    return blocks_.try_emplace({row, column}, Matrix6d::Zero()).first->second;
  }

  Eigen::SparseMatrix<double> PoseMatrix() const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(36 * blocks_.size());
    for (const auto& [place, block] : blocks_) {
      for (int i = 0; i < 36; ++i) {
        entries.emplace_back(6 * place.first + i % 6, 6 * place.second + i / 6, block(i));
      }
    }
    Eigen::SparseMatrix<double> matrix(pose_camera_.rows(), pose_camera_.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  std::map<std::pair<int, int>, Matrix6d> blocks_;
  Eigen::MatrixXd pose_camera_;
  Eigen::MatrixXd camera_;
};

Eigen::MatrixXd InformationOf(const Bundle& bundle, const std::vector<char>& is_joint,
                              const DifferentiableCamera& adjusted, int num_free) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  const std::vector<int> offsets = ObservationOffsets(bundle);
  ReducedInformation information(static_cast<int>(bundle.views.size()), num_free);
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (!is_joint[point]) continue;
    std::vector<Linearized> of_point;
    for (int i = offsets[point]; i < offsets[point + 1]; ++i) {
      const Bundle::Observation& observation = bundle.observations[i];
      if (!observation.is_inlier) continue;
      const auto linearized = Linearize(adjusted, camera_from_local[observation.view],
                                        bundle.points[point].in_local, observation);
      if (linearized) of_point.push_back(*linearized);
    }
    if (of_point.size() > 1) information.AddPoint(of_point);
  }
  return information.MarginalizePoses(bundle.views);
}

/// Inverts an information matrix in units that make its diagonal 1. Returns infinities if the
/// matrix is singular.
Eigen::MatrixXd Invert(const Eigen::MatrixXd& information) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd units = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::FullPivLU<Eigen::MatrixXd> scaled(units.asDiagonal() * information *
                                                 units.asDiagonal());
  if (!units.allFinite() || !scaled.isInvertible()) {
    return Eigen::MatrixXd::Constant(information.rows(), information.cols(), infinity);
  }
  return units.asDiagonal() * scaled.inverse() * units.asDiagonal();
}

}  // namespace

Eigen::MatrixXd ObservedInformation(const CameraPrior& prior, const AdjustmentState& state) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(prior.num_free(), prior.num_free());
  if (prior.num_free() == 0) return information;
  const DifferentiableCamera adjusted(prior, state.difference);
  for (std::size_t i = 0; i < state.bundles.size(); ++i) {
    information += InformationOf(state.bundles[i], state.is_joint[i], adjusted, prior.num_free());
  }
  return information;
}

Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const Eigen::MatrixXd& information) {
  if (prior.num_free() == 0) return {};
  return Invert(information + PriorInformation(prior));
}

}  // namespace corvo
