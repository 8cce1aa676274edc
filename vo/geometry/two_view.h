// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/geometry/planar_motion.h"
#include "vo/geometry/ray_match.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"

namespace corvo {

/// How well one model explains the matches: sum over matches of what the squared error (in units of
/// sigma²) stays below a common bound, as in Mur-Artal et al., "ORB-SLAM", 2015, section IV.
struct ModelScore {
  double score = 0;
  int num_inliers = 0;
  std::vector<char> is_inlier;
};

/// Squared distance of both rays from their epipolar lines; bound for an inlier χ² with 1 degree.
ModelScore ScoreEssential(const Eigen::Matrix3d& second_from_first_essential,
                          const std::vector<RayMatch>& matches);
/// Squared transfer error both ways; bound for an inlier χ² with 2 degrees.
ModelScore ScoreHomography(const Eigen::Matrix3d& second_from_first_homography,
                           const std::vector<RayMatch>& matches);

/// A point seen in both views.
struct TwoViewPoint {
  int match = kNoId;  ///< Index of its match.
  Eigen::Vector3d in_first;
  double parallax = 0;  ///< Radians.
};

/// The motion between two views, or why there is none.
struct TwoViewResult {
  SE3 first_from_second;  ///< The baseline has length 1.
  /// Set if the camera turned or stood still, as far as the matches tell (kRotationOnly,
  /// kLowParallax).
  std::optional<SO3> first_from_second_rotation;
  /// What the plane allows, if there is one (kPlanar).
  std::vector<PlanarMotion> planar_motions;
  std::vector<TwoViewPoint> points;
  double parallax_deg = 0;  ///< Median over the matches, rotation removed.
  int num_inliers = 0;
  Reason reason = Reason::kNone;  ///< kNone: the motion is accepted.
};

/// Whether a rotation alone explains the matches: then `first_from_second_rotation` and the reason
/// are set. `parallax_deg` always is.
TwoViewResult CheckPureRotation(const std::vector<RayMatch>& matches,
                                const InitializerOptions& options);

/// Essential matrix (robust, fixed seed) against homography and pure rotation. Estimators return a
/// confident essential matrix under pure rotation and for planes, so its own inliers never decide:
/// accepted only if there are enough matches, if there is parallax, if the homography does not
/// explain the matches too, and if one of the four motions in E clearly puts the most points in
/// front of both views.
TwoViewResult EstimateTwoViewMotion(const std::vector<RayMatch>& matches,
                                    const InitializerOptions& options);

/// One of the motions that a plane allows, accepted on the same terms.
TwoViewResult TriangulatePlanarMotion(const std::vector<RayMatch>& matches,
                                      const PlanarMotion& motion,
                                      const InitializerOptions& options);

}  // namespace corvo
