// SPDX-License-Identifier: MIT
#include "vo/optimization/reduced_information.h"

#include <optional>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

namespace corvo {
namespace {

std::optional<LinearizedObservation> Linearize(const DifferentiableCamera& adjusted,
                                               const SE3& camera_from_local,
                                               const Eigen::Vector3d& in_local,
                                               const Bundle::Observation& observation) {
  const Eigen::Vector3d in_camera = camera_from_local * in_local;
  Camera::Jacobian by_camera_point;
  const auto pixel = adjusted.camera().Project(in_camera, &by_camera_point);
  if (!pixel) return std::nullopt;
  by_camera_point /= observation.sigma_px;
  LinearizedObservation linearized;
  linearized.view = observation.view;
  linearized.error = (observation.pixel - *pixel) / observation.sigma_px;
  linearized.by_pose << -by_camera_point, by_camera_point * SO3::Hat(in_camera);
  linearized.by_point = by_camera_point * camera_from_local.rotation().matrix();
  linearized.by_camera = adjusted.PixelByDifference(in_camera, *pixel) / observation.sigma_px;
  return linearized;
}

}  // namespace

void VisitLinearizedPoints(
    const Bundle& bundle, const std::vector<char>& is_joint, const DifferentiableCamera& camera,
    const std::function<void(int, const std::vector<LinearizedObservation>&)>& visit) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  const std::vector<int> offsets = ObservationOffsets(bundle);
  for (int point = 0; point < static_cast<int>(bundle.points.size()); ++point) {
    if (!is_joint[point]) continue;
    std::vector<LinearizedObservation> of_point;
    for (int i = offsets[point]; i < offsets[point + 1]; ++i) {
      const Bundle::Observation& observation = bundle.observations[i];
      if (!observation.is_inlier) continue;
      const auto linearized = Linearize(camera, camera_from_local[observation.view],
                                        bundle.points[point].in_local, observation);
      if (linearized) of_point.push_back(*linearized);
    }
    if (of_point.size() > 1) visit(point, of_point);
  }
}

ReducedInformation::ReducedInformation(const Bundle& bundle, const std::vector<char>& is_joint,
                                       const DifferentiableCamera& camera, int num_free)
    : pose_camera_(Eigen::MatrixXd::Zero(6 * static_cast<int>(bundle.views.size()), num_free)),
      camera_(Eigen::MatrixXd::Zero(num_free, num_free)),
      pose_vector_(Eigen::VectorXd::Zero(pose_camera_.rows())),
      camera_vector_(Eigen::VectorXd::Zero(num_free)) {
  VisitLinearizedPoints(bundle, is_joint, camera,
                        [&](int /*point*/, const auto& observations) { AddPoint(observations); });
}

Eigen::SparseMatrix<double> ReducedInformation::PoseMatrix() const {
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

CameraInformation ReducedInformation::MarginalizePoses(const std::vector<Bundle::View>& views) {
  constexpr double kFixed = 1e12, kGauge = 1e-3;
  for (int view = 0; view < static_cast<int>(views.size()); ++view) {
    const bool is_known = views[view].is_fixed || view == 0;
    Block(view, view).diagonal().array() += is_known ? kFixed : kGauge;
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> poses(PoseMatrix());
  const Eigen::MatrixXd camera_by_pose = poses.solve(pose_camera_).transpose();
  return {camera_ - camera_by_pose * pose_camera_, camera_vector_ - camera_by_pose * pose_vector_};
}

void ReducedInformation::AddPoint(const std::vector<LinearizedObservation>& observations) {
  Eigen::Matrix3d point = Eigen::Matrix3d::Zero();
  Eigen::Vector3d point_vector = Eigen::Vector3d::Zero();
  Eigen::MatrixXd camera_point = Eigen::MatrixXd::Zero(camera_.rows(), 3);
  for (const LinearizedObservation& s : observations) {
    point += s.by_point.transpose() * s.by_point;
    point_vector += s.by_point.transpose() * s.error;
    camera_point += s.by_camera.transpose() * s.by_point;
  }
  if (point.determinant() < 1e-12) return;
  const Eigen::Matrix3d covariance = point.inverse();
  for (const LinearizedObservation& a : observations) {
    const Eigen::Matrix<double, 6, 3> gain = a.by_pose.transpose() * a.by_point * covariance;
    Block(a.view, a.view) += a.by_pose.transpose() * a.by_pose;
    pose_vector_.segment<6>(6 * a.view) += a.by_pose.transpose() * a.error - gain * point_vector;
    for (const LinearizedObservation& b : observations) {
      if (b.view <= a.view) {
        Block(a.view, b.view) -= gain * (b.by_point.transpose() * b.by_pose);
      }
    }
    // A block of a matrix without columns would be at an offset from a null pointer.
    if (camera_.cols() == 0) continue;
    pose_camera_.middleRows<6>(6 * a.view) +=
        a.by_pose.transpose() * a.by_camera - gain * camera_point.transpose();
    camera_ += a.by_camera.transpose() * a.by_camera;
    camera_vector_ += a.by_camera.transpose() * a.error;
  }
  camera_ -= camera_point * covariance * camera_point.transpose();
  camera_vector_ -= camera_point * covariance * point_vector;
}

SE3::Matrix6& ReducedInformation::Block(int row, int column) {
  return blocks_.try_emplace({row, column}, SE3::Matrix6::Zero()).first->second;
}

}  // namespace corvo
