// SPDX-License-Identifier: MIT
#include "vo/tracking/segment_start.h"

#include <cmath>

namespace corvo {

SE3 PredictFirstPose(const Frame& first, const std::optional<SO3>& world_from_first_rotation,
                     const Frame& previous, const MotionModel& motion) {
  if (!world_from_first_rotation) return motion.Predict(previous, first.time_ns);
  return SE3(*world_from_first_rotation, previous.world_from_camera.translation());
}

InitialMap ScaleToSpeed(InitialMap map, TimeNs baseline_ns,
                        const std::optional<SpeedGuess>& speed) {
  if (!speed) return map;
  const double distance = speed->speed * 1e-9 * static_cast<double>(baseline_ns);
  const double scale = distance / map.first_from_second.translation().norm();
  map.first_from_second =
      SE3(map.first_from_second.rotation(), scale * map.first_from_second.translation());
  for (InitialPoint& point : map.points) point.in_first *= scale;
  return map;
}

SegmentScale ScaleOf(const std::optional<SpeedGuess>& speed) {
  if (!speed) return {};
  return {ScaleSource::kMedianSpeed, std::exp(speed->log_sigma)};
}

}  // namespace corvo
