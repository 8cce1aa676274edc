// SPDX-License-Identifier: MIT
#include "vo/optimization/keyframe_covariance.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "vo/camera/differentiable_camera.h"
#include "vo/optimization/reduced_information.h"

namespace corvo {
namespace {

/// Returns the views of a bundle whose poses are not exact.
std::vector<int> UncertainViews(const Bundle& bundle) {
  const auto num_fixed = std::ranges::count_if(bundle.views, &Bundle::View::is_fixed);
  std::vector<int> uncertain;
  for (int view = 0; view < static_cast<int>(bundle.views.size()); ++view) {
    const bool is_reference = num_fixed < 2 && view == 0;
    if (!bundle.views[view].is_fixed && !is_reference) uncertain.push_back(view);
  }
  return uncertain;
}

/// Whether the observations leave the scale of the bundle open.
bool IsScaleFree(const Bundle& bundle) {
  const auto num_fixed = std::ranges::count_if(bundle.views, &Bundle::View::is_fixed);
  return num_fixed == 0 || (num_fixed == 1 && bundle.views.front().is_fixed);
}

/// Holds the distance of the farthest of the views from the oldest one.
void HoldScale(const Bundle& bundle, const std::vector<int>& views, Eigen::MatrixXd& information) {
  constexpr double kFixed = 1e4;  // Relative to the information there is.
  const auto farthest = std::ranges::max_element(
      views, {}, [&](int view) { return bundle.views[view].Pose().translation().squaredNorm(); });
  const SE3 pose = bundle.views[*farthest].Pose();
  const Eigen::Vector3d direction = pose.rotation().Inverse() * pose.translation().normalized();
  const Eigen::Index row = 6 * (farthest - views.begin());
  const double weight = kFixed * information.block<3, 3>(row, row).trace();
  information.block<3, 3>(row, row) += weight * direction * direction.transpose();
}

/// Returns the rows and columns of some views of a matrix whose lower triangle is filled.
Eigen::MatrixXd SelectViews(const Eigen::SparseMatrix<double>& lower,
                            const std::vector<int>& views) {
  Eigen::VectorXi position = Eigen::VectorXi::Constant(lower.rows() / 6, kNoId);
  for (int i = 0; i < static_cast<int>(views.size()); ++i) position[views[i]] = i;
  const auto size = static_cast<Eigen::Index>(6 * views.size());
  Eigen::MatrixXd selected = Eigen::MatrixXd::Zero(size, size);
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      const int a = position[entry.row() / 6], b = position[column / 6];
      if (a == kNoId || b == kNoId) continue;
      selected(6 * a + entry.row() % 6, 6 * b + column % 6) = entry.value();
    }
  }
  return selected.selfadjointView<Eigen::Lower>();
}

/// Returns the rows of some views of a matrix with 6 rows for each view.
Eigen::MatrixXd SelectRows(const Eigen::MatrixXd& matrix, const std::vector<int>& views) {
  Eigen::MatrixXd selected(6 * static_cast<Eigen::Index>(views.size()), matrix.cols());
  for (std::size_t i = 0; i < views.size(); ++i) {
    selected.middleRows<6>(6 * static_cast<Eigen::Index>(i)) = matrix.middleRows<6>(6 * views[i]);
  }
  return selected;
}

/// Returns a matrix with 6 rows for each view of a bundle, which is 0 but for the rows of some
/// views.
Eigen::MatrixXd SpreadRows(const Eigen::MatrixXd& rows, const std::vector<int>& views,
                           const Bundle& bundle) {
  Eigen::MatrixXd spread =
      Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(bundle.views.size()), rows.cols());
  for (std::size_t i = 0; i < views.size(); ++i) {
    spread.middleRows<6>(6 * views[i]) = rows.middleRows<6>(6 * static_cast<Eigen::Index>(i));
  }
  return spread;
}

/// Sets the derivatives of the joint points, which follow the camera and their views.
/// `views_by_camera` has 6 rows for each view.
void SetLandmarksByCamera(const Bundle& bundle, const std::vector<char>& is_joint,
                          const DifferentiableCamera& camera,
                          const Eigen::MatrixXd& views_by_camera, KeyframeCovariance& covariance) {
  const Eigen::Matrix3d world_from_local = bundle.world_from_local.rotation().matrix();
  VisitLinearizedPoints(bundle, is_joint, camera, [&](int point, const auto& observations) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Matrix3Xd by_camera = Eigen::Matrix3Xd::Zero(3, views_by_camera.cols());
    for (const LinearizedObservation& o : observations) {
      information += o.by_point.transpose() * o.by_point;
      by_camera += o.by_point.transpose() * o.by_camera;
      by_camera += o.by_point.transpose() * (o.by_pose * views_by_camera.middleRows<6>(6 * o.view));
    }
    covariance.landmarks_by_camera[bundle.points[point].landmark] =
        -world_from_local * information.ldlt().solve(by_camera);
  });
}

}  // namespace

int KeyframeCovariance::Find(KeyframeId keyframe) const {
  const auto found = std::ranges::lower_bound(keyframes, keyframe);
  if (found == keyframes.end() || *found != keyframe) return kNoId;
  return static_cast<int>(found - keyframes.begin());
}

Eigen::Matrix<double, 6, Eigen::Dynamic> KeyframeCovariance::ByCamera(int position) const {
  // A block of a matrix without columns would be at an offset from a null pointer.
  if (by_camera.cols() == 0) return Eigen::Matrix<double, 6, Eigen::Dynamic>(6, 0);
  return by_camera.middleRows<6>(6 * position);
}

KeyframeCovariance CovarianceOfViews(const CameraPrior& camera, const Bundle& bundle,
                                     const std::vector<char>& is_joint) {
  constexpr double kUnobserved = 1e-9;  // Keeps views without observations finite.
  const int num_free = camera.num_free();
  const DifferentiableCamera differentiable(camera, Eigen::VectorXd::Zero(num_free));
  const std::vector<int> views = UncertainViews(bundle);
  KeyframeCovariance covariance;
  for (const int view : views) {
    const KeyframeId keyframe = bundle.views[view].keyframe;
    if (keyframe != kNoId) covariance.keyframes.push_back(keyframe);
  }
  covariance.by_camera = Eigen::MatrixXd::Zero(0, num_free);
  if (covariance.keyframes.empty()) return covariance;
  const ReducedInformation reduced(bundle, is_joint, differentiable, num_free);
  Eigen::MatrixXd information = SelectViews(reduced.PoseMatrix(), views);
  if (IsScaleFree(bundle)) HoldScale(bundle, views, information);
  information.diagonal().array() += kUnobserved;
  const Eigen::LDLT<Eigen::MatrixXd> solver(information);
  // The other frames are marginalized: they follow the keyframes, whose rows are the first.
  const Eigen::Index rows = 6 * covariance.size();
  covariance.matrix =
      solver.solve(Eigen::MatrixXd::Identity(information.rows(), rows)).topRows(rows);
  covariance.by_camera = Eigen::MatrixXd::Zero(rows, num_free);
  if (num_free == 0) return covariance;
  const Eigen::MatrixXd by_camera = -solver.solve(SelectRows(reduced.pose_camera(), views));
  covariance.by_camera = by_camera.topRows(rows);
  SetLandmarksByCamera(bundle, is_joint, differentiable, SpreadRows(by_camera, views, bundle),
                       covariance);
  return covariance;
}

}  // namespace corvo
