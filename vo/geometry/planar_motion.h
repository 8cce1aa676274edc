// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/geometry/ray_match.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A motion between two views of a plane, and the plane: H = R + t nᵀ maps rays of the first view
/// to the second, (R, t) = second_from_first, n · x_in_first = 1.
struct PlanarMotion {
  SE3 second_from_first;            ///< In units of the plane's distance from the first camera.
  Eigen::Vector3d normal_in_first;  ///< Unit vector, away from the first camera.
};

/// The motions that a homography allows if the inliers lie in front of both cameras: one or, in
/// general, two (Malis and Vargas, "Deeper understanding of the homography decomposition for
/// vision-based control", 2007): at least `min_share_before_plane` of the rays must meet the plane
/// in front of the first camera. None for a rotation, which shows no plane.
std::vector<PlanarMotion> DecomposeHomography(const Eigen::Matrix3d& second_from_first_homography,
                                              const std::vector<RayMatch>& matches,
                                              const std::vector<char>& is_inlier,
                                              double min_share_before_plane = 0.98);

/// Tells the true motion from its twin by waiting: the plane stays where it is, so its normal in
/// the reference view is among those of every view; the twin's moves with the motion.
class PlaneHypotheses {
 public:
  /// Of a new view's motions from the frame `reference`, those whose plane is among the ones left
  /// by the views before, normals within `max_angle_deg` being the same plane's. None for the first
  /// view of a reference, and where none agrees, which starts again.
  std::vector<PlanarMotion> Keep(int reference, const std::vector<PlanarMotion>& motions,
                                 double max_angle_deg);

 private:
  int reference_ = kNoId;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace corvo
