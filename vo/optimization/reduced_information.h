// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "vo/camera/camera_information.h"
#include "vo/camera/differentiable_camera.h"
#include "vo/lie/se3.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The error of an observation, the pixel less its prediction, and the derivatives of the
/// prediction with respect to the pose of its view (a perturbation on the right), to its point in
/// the bundle's frame, and to the free parameters of the camera; all in units of sigma.
struct LinearizedObservation {
  int view = 0;
  Eigen::Vector2d error;
  Eigen::Matrix<double, 2, 6> by_pose;
  Eigen::Matrix<double, 2, 3> by_point;
  DifferentiableCamera::Jacobian by_camera;
};

/// Calls `visit` with the index and the linearized inlier observations of each point that is
/// flagged in `is_joint` and has two of them or more.
void VisitLinearizedPoints(
    const Bundle& bundle, const std::vector<char>& is_joint, const DifferentiableCamera& camera,
    const std::function<void(int, const std::vector<LinearizedObservation>&)>& visit);

/// The information of the observations of one bundle about its poses (six parameters for each view)
/// and the camera: the normal equations with the points eliminated by Schur complements. It is
/// sparse in the views.
class ReducedInformation {
 public:
  /// Takes the inlier observations of the points that are flagged in `is_joint`.
  ReducedInformation(const Bundle& bundle, const std::vector<char>& is_joint,
                     const DifferentiableCamera& camera, int num_free);

  /// Returns the symmetric information about the poses, 6 rows and columns for each view. Its
  /// lower triangle alone is filled.
  Eigen::SparseMatrix<double> PoseMatrix() const;

  /// Returns the information that poses and camera share: a row for each row of PoseMatrix(), a
  /// column for each free parameter.
  const Eigen::MatrixXd& pose_camera() const { return pose_camera_; }

  /// Returns the normal equations of a change of the camera with the poses marginalized. Fixed
  /// views, and the oldest one, are known exactly.
  CameraInformation MarginalizePoses(const std::vector<Bundle::View>& views);

 private:
  /// Adds the observations of one point.
  void AddPoint(const std::vector<LinearizedObservation>& observations);
  /// Returns a block of the lower triangle of the poses' information.
  SE3::Matrix6& Block(int row, int column);

  std::map<std::pair<int, int>, SE3::Matrix6> blocks_;
  Eigen::MatrixXd pose_camera_;
  Eigen::MatrixXd camera_;
  Eigen::VectorXd pose_vector_;  // The right-hand sides.
  Eigen::VectorXd camera_vector_;
};

}  // namespace corvo
