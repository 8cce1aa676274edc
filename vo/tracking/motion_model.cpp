// SPDX-License-Identifier: MIT
#include "vo/tracking/motion_model.h"

namespace corvo {

void MotionModel::Update(const Frame& earlier, const Frame& later) {
  earlier_from_later_ = earlier.world_from_camera.Inverse() * later.world_from_camera;
  step_ns_ = later.time_ns - earlier.time_ns;
}

SE3 MotionModel::Predict(const Frame& from, TimeNs time_ns) const {
  if (step_ns_ == 0) return from.world_from_camera;
  const double steps = static_cast<double>(time_ns - from.time_ns) / static_cast<double>(step_ns_);
  return from.world_from_camera * earlier_from_later_.Power(steps);
}

std::vector<SE3> MotionModel::PredictAlternatives(const Frame& from, TimeNs time_ns) const {
  std::vector<SE3> poses = {Predict(from, time_ns)};
  if (step_ns_ == 0) return poses;
  if (time_ns - from.time_ns != step_ns_) {
    poses.push_back(from.world_from_camera * earlier_from_later_);
  }
  poses.push_back(from.world_from_camera);
  return poses;
}

}  // namespace corvo
