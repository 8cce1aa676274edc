// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/trajectory.h"

namespace corvo {

/// A point as seen from the place of a path that is nearest to it, in units of the segment.
struct PassedPoint {
  int place = 0;      ///< Index of the place.
  double right = 0;   ///< Distance to the right of the camera.
  double below = 0;   ///< Distance below the camera, perpendicular to its motion.
  double beyond = 0;  ///< Distance along the motion: it is 0 except beyond the ends and in bends.
};

/// The path of a camera through a segment: places between which the camera moved by at least half
/// of its usual step, so that each has a direction of motion.
class CameraPath {
 public:
  struct Place {
    int frame = 0;  ///< Index of the frame.
    SE3 world_from_camera;
    double distance = 0;  ///< Length of the path up to here.
    Eigen::Vector3d forward =
        Eigen::Vector3d::Zero();                      ///< Unit vector of the motion, in the world.
    Eigen::Vector3d right = Eigen::Vector3d::Zero();  ///< Unit vector, perpendicular to it.
    Eigen::Vector3d down = Eigen::Vector3d::Zero();   ///< The camera's y axis, perpendicular to it.
  };

  CameraPath(const Trajectory& trajectory, int segment);

  /// In order of time; empty if the segment has no poses. If the camera did not move, it is one
  /// place without a direction.
  const std::vector<Place>& places() const { return places_; }

  /// Returns the index of the place that is nearest to a point. The path must not be empty.
  int Nearest(const Eigen::Vector3d& in_world) const;

  /// Returns the point as the camera passed it. The path must not be empty.
  PassedPoint Pass(const Eigen::Vector3d& in_world) const;

 private:
  /// Consecutive places and a sphere around them.
  struct Stretch {
    int first = 0;
    int last = 0;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0;
  };

  void AddPlaces(const Trajectory& trajectory, int segment);
  void FindDirections();
  void FindStretches();

  std::vector<Place> places_;
  std::vector<Stretch> stretches_;
};

}  // namespace corvo
