// SPDX-License-Identifier: MIT
#include "apps/synthetic/motion.h"

#include <cmath>

namespace corvo::synthetic {
namespace {

/// Returns the sum of two incommensurate waves of about 1 and 2 Hz, within ±1. The waves differ
/// between channels.
double Tremor(double seconds, int channel) {
  return 0.6 * std::sin((5.9 + 0.83 * channel) * seconds + 1.7 * channel) +
         0.4 * std::sin((12.7 - 0.57 * channel) * seconds + 2.9 * channel);
}

}  // namespace

SE3 SceneFromCamera(const Viewpoint& viewpoint) {
  const double cos_yaw = std::cos(viewpoint.yaw), sin_yaw = std::sin(viewpoint.yaw);
  const double cos_pitch = std::cos(viewpoint.pitch), sin_pitch = std::sin(viewpoint.pitch);
  const Eigen::Vector3d forward(cos_yaw * cos_pitch, sin_yaw * cos_pitch, sin_pitch);
  const Eigen::Vector3d right(sin_yaw, -cos_yaw, 0);
  const Eigen::Vector3d down = forward.cross(right);
  const double cos_roll = std::cos(viewpoint.roll), sin_roll = std::sin(viewpoint.roll);
  Eigen::Matrix3d rotation;
  rotation.col(0) = cos_roll * right + sin_roll * down;
  rotation.col(1) = cos_roll * down - sin_roll * right;
  rotation.col(2) = forward;
  return SE3(SO3(rotation), viewpoint.position);
}

Viewpoint ShakenByHand(Viewpoint viewpoint, double seconds) {
  viewpoint.position +=
      0.005 * Eigen::Vector3d(Tremor(seconds, 0), Tremor(seconds, 1), Tremor(seconds, 2));
  viewpoint.yaw += 0.006 * Tremor(seconds, 3);
  viewpoint.pitch += 0.006 * Tremor(seconds, 4);
  viewpoint.roll += 0.006 * Tremor(seconds, 5);
  return viewpoint;
}

Camera ChooseCamera(const CameraParameters& camera, const SequenceOptions& options) {
  options.Validate();
  if (options.camera) return Camera(*options.camera);
  if (options.width == 0) return Camera(camera);
  const double scale = static_cast<double>(options.width) / camera.width;
  CameraParameters scaled = camera;
  scaled.width = options.width;
  scaled.height = static_cast<int>(std::lround(scale * camera.height));
  scaled.fx *= scale;
  scaled.fy *= scale;
  scaled.cx = (camera.cx + 0.5) * scale - 0.5;
  scaled.cy = (camera.cy + 0.5) * scale - 0.5;
  return Camera(scaled);
}

}  // namespace corvo::synthetic
