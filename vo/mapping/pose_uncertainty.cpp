// SPDX-License-Identifier: MIT
#include "vo/mapping/pose_uncertainty.h"

#include <algorithm>
#include <utility>

#include "vo/mapping/pose_health.h"
#include "vo/optimization/adjustment_window.h"
#include "vo/optimization/bundle.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

// The errors of successive frames are not independent: they see the same landmarks. Measured on
// rendered sequences, see docs/uncertainty.md.
constexpr double kCorrelation = 1.5;

using Gains = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Returns the gains of a pose with respect to all keyframes of the joint covariance.
Gains JoinGains(const PoseDependence& dependence, const KeyframeCovariance& joint) {
  Gains gains = Gains::Zero(6, 6 * joint.size());
  for (std::size_t i = 0; i < dependence.keyframes.size(); ++i) {
    const int position = joint.Find(dependence.keyframes[i]);
    if (position != kNoId) gains.middleCols<6>(6 * position) = dependence.gains[i];
  }
  return gains;
}

/// Returns G P Gᵀ.
SE3::Matrix6 Propagate(const Gains& gains, const Eigen::MatrixXd& covariance) {
  if (gains.cols() == 0) return SE3::Matrix6::Zero();
  return gains * covariance * gains.transpose();
}

/// Returns the newest active keyframe of a joint covariance, or kNoId.
KeyframeId NewestActive(const Map& map, const KeyframeCovariance& joint) {
  for (auto id = joint.keyframes.rbegin(); id != joint.keyframes.rend(); ++id) {
    if (map.IsActive(*id)) return *id;
  }
  return kNoId;
}

/// Whether a frame observes landmarks of keyframes of a joint covariance.
bool IsAmong(const Map& map, const Frame& frame, const KeyframeCovariance& joint) {
  return std::ranges::any_of(frame.landmarks, [&](LandmarkId id) {
    const Landmark* landmark = map.FindLandmark(id);
    return landmark != nullptr && std::ranges::any_of(landmark->track, [&](const auto& element) {
             return joint.Find(element.keyframe) != kNoId;
           });
  });
}

}  // namespace

KeyframeId KeyframeBefore(const Map& map, KeyframeId keyframe) {
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  for (auto id = active.rbegin(); id != active.rend(); ++id) {
    if (*id < keyframe && map.SegmentOf(*id) == map.SegmentOf(keyframe)) return *id;
  }
  return kNoId;
}

PoseUncertainty::PoseUncertainty(const CameraPrior& prior, const BundleAdjusterOptions& options)
    : free_(prior.free), window_options_(options) {
  joint_.by_camera = Eigen::MatrixXd::Zero(0, prior.num_free());
}

void PoseUncertainty::UseWindow(KeyframeCovariance window) {
  if (window.keyframes.empty()) return;
  joint_ = std::move(window);
  std::erase_if(added_,
                [&](const Added& added) { return added.keyframe <= joint_.keyframes.back(); });
  for (const Added& added : added_) Append(added);
}

void PoseUncertainty::ComputeWindow(const Map& map, KeyframeId keyframe) {
  const Bundle bundle = CopyBundle(map, SelectWindow(map, keyframe, window_options_));
  added_.clear();
  joint_ = CovarianceOfViews(CameraOf(map), bundle,
                             SelectPoints(bundle, window_options_.points_per_keyframe));
}

void PoseUncertainty::AddKeyframe(const Map& map, const Frame& frame) {
  // Adjustments that fail leave the window as it was.
  if (joint_.size() > 2 * window_options_.max_keyframes) {
    ComputeWindow(map, map.num_keyframes() - 1);
  }
  added_.push_back({map.num_keyframes(), LinearizePose(map, frame, joint_, CameraOf(map))});
  Append(added_.back());
}

void PoseUncertainty::Append(const Added& added) {
  const Gains gains = JoinGains(added.dependence, joint_);
  const Eigen::Index size = joint_.matrix.rows();
  const Gains with_others = gains * joint_.matrix;
  Eigen::MatrixXd matrix(size + 6, size + 6);
  matrix.topLeftCorner(size, size) = joint_.matrix;
  matrix.topRightCorner(size, 6) = with_others.transpose();
  matrix.bottomLeftCorner(6, size) = with_others;
  matrix.bottomRightCorner<6, 6>() = with_others * gains.transpose() + added.dependence.noise;
  joint_.by_camera.conservativeResize(size + 6, Eigen::NoChange);
  if (!free_.empty()) joint_.by_camera.bottomRows<6>() = added.dependence.by_camera;
  joint_.keyframes.push_back(added.keyframe);
  joint_.matrix = std::move(matrix);
}

std::optional<UncertaintyToKeyframe> PoseUncertainty::OfFrame(const Map& map, const Frame& frame,
                                                              const CameraEstimate& camera) {
  if (!IsAmong(map, frame, joint_)) {
    const std::vector<Covisible> covisible = map.FindCovisible(frame);
    if (!covisible.empty()) ComputeWindow(map, covisible.front().keyframe);
  }
  const KeyframeId reference = NewestActive(map, joint_);
  if (reference == kNoId) return std::nullopt;
  const PoseDependence dependence = LinearizePose(map, frame, joint_, CameraOf(map));
  variance_.Add(dependence);
  factor_ = kCorrelation * variance_.Of(dependence);
  const int position = joint_.Find(reference);
  const SE3::Matrix6 adjoint =
      (frame.world_from_camera.Inverse() * map.WorldFromKeyframe(reference)).Adjoint();
  Gains gains = JoinGains(dependence, joint_);
  gains.middleCols<6>(6 * position) -= adjoint;
  const Gains by_camera = dependence.by_camera - adjoint * joint_.ByCamera(position);
  const SE3::Matrix6 covariance = factor_ * (dependence.noise + Propagate(gains, joint_.matrix)) +
                                  Propagate(by_camera, camera.covariance);
  return UncertaintyToKeyframe{reference, covariance,
                               AssessPose(frame, map.camera(), dependence, factor_, covariance)};
}

std::optional<UncertaintyToKeyframe> PoseUncertainty::OfNewestKeyframe(
    const Map& map, const Frame& frame, const CameraEstimate& camera) const {
  const KeyframeId keyframe = map.num_keyframes() - 1;
  const KeyframeId reference = KeyframeBefore(map, keyframe);
  if (reference == kNoId || joint_.Find(keyframe) == kNoId) return std::nullopt;
  const bool is_added = !added_.empty() && added_.back().keyframe == keyframe;
  const PoseDependence dependence =
      is_added ? added_.back().dependence
               : LinearizePose(map, frame, {}, {map.camera().parameters(), {}});
  const SE3::Matrix6 covariance = Between(map, reference, keyframe, camera);
  return UncertaintyToKeyframe{reference, covariance,
                               AssessPose(frame, map.camera(), dependence, factor_, covariance)};
}

SE3::Matrix6 PoseUncertainty::Between(const Map& map, KeyframeId first, KeyframeId second,
                                      const CameraEstimate& camera) const {
  const SE3::Matrix6 adjoint =
      (map.WorldFromKeyframe(second).Inverse() * map.WorldFromKeyframe(first)).Adjoint();
  const int a = joint_.Find(first), b = joint_.Find(second);
  SE3::Matrix6 of_noise = SE3::Matrix6::Zero();
  Gains by_camera = Gains::Zero(6, joint_.by_camera.cols());
  if (b != kNoId) {
    of_noise += joint_.Block(b, b);
    by_camera += joint_.ByCamera(b);
  }
  if (a != kNoId) {
    of_noise += adjoint * joint_.Block(a, a) * adjoint.transpose();
    by_camera -= adjoint * joint_.ByCamera(a);
  }
  if (a != kNoId && b != kNoId) {
    const SE3::Matrix6 both = adjoint * joint_.Block(a, b);
    of_noise -= both + both.transpose();
  }
  return factor_ * of_noise + Propagate(by_camera, camera.covariance);
}

}  // namespace corvo
