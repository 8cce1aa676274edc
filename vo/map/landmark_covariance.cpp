// SPDX-License-Identifier: MIT
#include "vo/map/landmark_covariance.h"

#include <Eigen/LU>

namespace corvo {

Eigen::Matrix3d LandmarkInformation(const Map& map, const Landmark& landmark,
                                    const TrackElement& observation) {
  const double sigma_along = map.model().options.sigma_along_ray;
  const Frame& frame = map.keyframe(observation.keyframe).frame;
  const Eigen::Vector3d ray = landmark.in_world - frame.world_from_camera.translation();
  const double squared_distance = ray.squaredNorm();
  const double sigma_across = map.model().Sigma(frame, observation.keypoint) / map.camera().focal();
  const Eigen::Matrix3d along = ray * ray.transpose() / squared_distance;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  return (across / (sigma_across * sigma_across) + along / (sigma_along * sigma_along)) /
         squared_distance;
}

Eigen::Matrix3d LandmarkCovariance(const Map& map, const Landmark& landmark) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const TrackElement& o : landmark.track) information += LandmarkInformation(map, landmark, o);
  return information.inverse();
}

}  // namespace corvo
