// SPDX-License-Identifier: MIT
#include "vo/optimization/pose_dependence.h"

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include "vo/camera/differentiable_camera.h"
#include "vo/map/landmark_covariance.h"
#include "vo/map/observation.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

using Matrix62 = Eigen::Matrix<double, 6, 2>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

std::vector<Eigen::Vector3d> TranslationsOf(const Map& map,
                                            const std::vector<KeyframeId>& keyframes) {
  std::vector<Eigen::Vector3d> translations;
  for (const KeyframeId id : keyframes) {
    translations.push_back(map.WorldFromKeyframe(id).translation());
  }
  return translations;
}

/// The normal equations of a pose, with the parts that keyframes have in them.
class PoseEquations {
 public:
  PoseEquations(const Map& map, const Frame& frame, const KeyframeCovariance& joint,
                const CameraPrior& camera)
      : map_(map),
        frame_(frame),
        camera_(camera, Eigen::VectorXd::Zero(camera.num_free())),
        camera_from_world_(frame.world_from_camera.Inverse()),
        joint_(joint),
        translations_(TranslationsOf(map, joint.keyframes)),
        by_keyframe_(joint.keyframes.size(), SE3::Matrix6::Zero()),
        by_camera_(Matrix6X::Zero(6, camera.num_free())) {}

  /// Adds the observation of a landmark by a keypoint.
  void Add(int keypoint, const Landmark& landmark) {
    const std::optional<Terms> terms = Linearize(keypoint, landmark);
    if (!terms) return;
    const Matrix62 weighted = terms->by_pose.transpose() * terms->information;
    hessian_ += weighted * terms->by_pose;
    AddKeyframes(landmark, weighted * terms->by_point * terms->point_covariance);
    AddCamera(landmark, weighted, *terms);
    AddStatistics(keypoint, landmark, *terms);
  }

  PoseDependence Solve() const {
    const Eigen::LDLT<SE3::Matrix6> solver(hessian_);
    PoseDependence dependence = statistics_;
    dependence.distance = Median(distances_);
    dependence.distance_sigma = Median(distance_sigmas_);
    dependence.keyframes = joint_.keyframes;
    for (std::size_t i = 0; i < by_keyframe_.size(); ++i) {
      dependence.gains.push_back(-solver.solve(Rotate(by_keyframe_[i], joint_.keyframes[i])));
    }
    dependence.by_camera = by_camera_;
    if (by_camera_.cols() > 0) {
      dependence.by_camera = -hessian_by_camera_.ldlt().solve(by_camera_);
    }
    dependence.noise = solver.solve(SE3::Matrix6::Identity());
    return dependence;
  }

 private:
  /// The parts of the normal equations of one observation.
  struct Terms {
    Eigen::Vector3d in_camera;
    Eigen::Vector2d projected;
    Eigen::Matrix<double, 2, 6> by_pose;
    Camera::Jacobian by_point;
    Eigen::Matrix3d point_covariance;
    Eigen::Matrix2d information;  // S⁻¹
  };

  std::optional<Terms> Linearize(int keypoint, const Landmark& landmark) {
    Terms terms;
    terms.in_camera = camera_from_world_ * landmark.in_world;
    Camera::Jacobian by_camera_point;
    const auto projected = map_.camera().Project(terms.in_camera, &by_camera_point);
    if (!projected) return std::nullopt;
    terms.projected = *projected;
    terms.by_pose << -by_camera_point, by_camera_point * SO3::Hat(terms.in_camera);
    terms.by_point = by_camera_point * camera_from_world_.rotation().matrix();
    terms.point_covariance = CovarianceOf(landmark);
    const double sigma_px = map_.model().Sigma(frame_, keypoint);
    terms.information = (sigma_px * sigma_px * Eigen::Matrix2d::Identity() +
                         terms.by_point * terms.point_covariance * terms.by_point.transpose())
                            .inverse();
    return terms;
  }

  /// Returns the LandmarkCovariance and keeps the information of each element of the track.
  Eigen::Matrix3d CovarianceOf(const Landmark& landmark) {
    information_.clear();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const TrackElement& element : landmark.track) {
      information_.push_back(LandmarkInformation(map_, landmark, element));
      sum += information_.back();
    }
    return sum.inverse();
  }

  /// Adds the parts of the keyframes that observe a landmark, given that of the landmark.
  void AddKeyframes(const Landmark& landmark, const Matrix63& by_landmark) {
    for (std::size_t i = 0; i < landmark.track.size(); ++i) {
      const int position = joint_.Find(landmark.track[i].keyframe);
      if (position == kNoId) continue;
      const Matrix63 part = by_landmark * information_[i];
      // Rₖ [I, -hat(x_in_k)] = [I, -hat(x - tₖ)] Rₖ; Rₖ is applied to the sum.
      const Eigen::Vector3d ray = landmark.in_world - translations_[position];
      SE3::Matrix6& sum = by_keyframe_[position];
      sum.leftCols<3>() += part;
      sum.rightCols<3>() -= part * SO3::Hat(ray);
    }
  }

  /// Adds the part of the camera, if the landmark's derivative is known.
  void AddCamera(const Landmark& landmark, const Matrix62& weighted, const Terms& terms) {
    const auto moved = joint_.landmarks_by_camera.find(landmark.id);
    if (moved == joint_.landmarks_by_camera.end()) return;
    hessian_by_camera_ += weighted * terms.by_pose;
    by_camera_ += weighted * (camera_.PixelByDifference(terms.in_camera, terms.projected) +
                              terms.by_point * moved->second);
  }

  void AddStatistics(int keypoint, const Landmark& landmark, const Terms& terms) {
    const Eigen::Vector2d error = terms.projected - frame_.pixel(keypoint);
    SquaredErrors& errors =
        frame_.is_aligned[keypoint] ? statistics_.aligned : statistics_.detected;
    errors.sum += error.dot(terms.information * error);
    errors.count += 2;
    const Eigen::Vector3d ray = landmark.in_world - frame_.world_from_camera.translation();
    distances_.push_back(ray.norm());
    distance_sigmas_.push_back(std::sqrt(ray.dot(terms.point_covariance * ray)) /
                               ray.squaredNorm());
  }

  /// Returns the part of a keyframe with respect to a perturbation in its own axes.
  SE3::Matrix6 Rotate(SE3::Matrix6 part, KeyframeId keyframe) const {
    const Eigen::Matrix3d rotation = map_.WorldFromKeyframe(keyframe).rotation().matrix();
    part.leftCols<3>() *= rotation;
    part.rightCols<3>() *= rotation;
    return part;
  }

  const Map& map_;
  const Frame& frame_;
  DifferentiableCamera camera_;
  SE3 camera_from_world_;
  const KeyframeCovariance& joint_;
  SE3::Matrix6 hessian_ = SE3::Matrix6::Zero();
  SE3::Matrix6 hessian_by_camera_ = SE3::Matrix6::Zero();
  std::vector<Eigen::Vector3d> translations_;  // Of the keyframes, in the world.
  std::vector<SE3::Matrix6> by_keyframe_;
  std::vector<Eigen::Matrix3d> information_;  // Of the track of the landmark being added.
  Matrix6X by_camera_;
  std::vector<double> distances_, distance_sigmas_;
  PoseDependence statistics_;  // Without the solution.
};

}  // namespace

PoseDependence LinearizePose(const Map& map, const Frame& frame, const KeyframeCovariance& joint,
                             const CameraPrior& camera) {
  PoseEquations equations(map, frame, joint, camera);
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
    if (landmark != nullptr) equations.Add(k, *landmark);
  }
  return equations.Solve();
}

}  // namespace corvo
