// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/geometry/ray_match.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A motion between two views of a plane, and the plane: H = R + t nᵀ maps rays of the first view
/// to the second, with (R, t) = second_from_first and n · x_in_first = 1.
struct PlanarMotion {
  SE3 second_from_first;  ///< Translation in units of the plane's distance from the first camera.
  Eigen::Vector3d normal_in_first;  ///< Unit vector that points away from the first camera.
};

/// Returns the motions that a homography allows if the inliers lie in front of both cameras: one
/// or, in general, two (Malis and Vargas, "Deeper understanding of the homography decomposition for
/// vision-based control", 2007). At least `min_share_before_plane` of the inliers' rays must meet
/// the plane in front of the first camera. Returns no motion for a pure rotation, which does not
/// determine a plane.
std::vector<PlanarMotion> DecomposeHomography(const Eigen::Matrix3d& second_from_first_homography,
                                              const std::vector<RayMatch>& matches,
                                              const std::vector<char>& is_inlier,
                                              double min_share_before_plane = 0.98);

/// Distinguishes the true motion from its twin over several views: the plane is static, so its
/// normal in the reference view is among the normals of every view, whereas the twin's normal
/// varies with the motion.
class PlaneHypotheses {
 public:
  /// Returns those `motions` of a new view, relative to the frame `reference`, whose plane is among
  /// the planes left by the previous views; normals within `max_angle_deg` belong to the same
  /// plane. Returns no motion for the first view of a reference, or if no plane matches, in which
  /// case the planes of `motions` replace the previous ones.
  std::vector<PlanarMotion> Keep(int reference, const std::vector<PlanarMotion>& motions,
                                 double max_angle_deg);

 private:
  int reference_ = kNoId;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace corvo
