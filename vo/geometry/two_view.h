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

/// The score of a model over all matches: the sum over the inlying errors of the margin between the
/// squared error, in units of sigma², and a bound common to both models (Mur-Artal et al.,
/// "ORB-SLAM", 2015, section IV).
struct ModelScore {
  double score = 0;
  int num_inliers = 0;
  std::vector<char> is_inlier;
};

/// Scores the squared distances of both rays from their epipolar lines. The inlier bound is the 95%
/// quantile of χ² with 1 degree of freedom.
ModelScore ScoreEssential(const Eigen::Matrix3d& second_from_first_essential,
                          const std::vector<RayMatch>& matches);
/// Scores the squared transfer errors in both directions. The inlier bound is the 95% quantile of
/// χ² with 2 degrees of freedom.
ModelScore ScoreHomography(const Eigen::Matrix3d& second_from_first_homography,
                           const std::vector<RayMatch>& matches);

/// A point observed in both views.
struct TwoViewPoint {
  int match = kNoId;  ///< Index of its match.
  Eigen::Vector3d in_first;
  double parallax = 0;  ///< Angle between the views, radians.
};

/// The motion between two views, or the reason why there is none.
struct TwoViewResult {
  SE3 first_from_second;  ///< The baseline has length 1.
  /// Set if, according to the matches, the camera only turned or stood still (kRotationOnly,
  /// kLowParallax).
  std::optional<SO3> first_from_second_rotation;
  /// The motions that a plane allows, if there is one (kPlanar).
  std::vector<PlanarMotion> planar_motions;
  std::vector<TwoViewPoint> points;
  double parallax_deg = 0;  ///< Median over the matches, rotation removed.
  int num_inliers = 0;
  Reason reason = Reason::kNone;  ///< kNone: the motion is accepted.
};

/// Checks whether a rotation alone explains the matches. If so, sets `first_from_second_rotation`
/// and the reason. Always sets `parallax_deg`.
TwoViewResult CheckPureRotation(const std::vector<RayMatch>& matches,
                                const InitializerOptions& options);

/// Estimates an essential matrix (robust, fixed seed) and compares it with a homography and a pure
/// rotation. Estimators return a confident essential matrix even for a pure rotation or a plane, so
/// its inliers alone never decide: the motion is accepted only if there are enough matches, if
/// there is parallax, if the homography does not explain the matches, too, and if one of the four
/// motions in E clearly puts the most points in front of both views.
TwoViewResult EstimateTwoViewMotion(const std::vector<RayMatch>& matches,
                                    const InitializerOptions& options);

/// Triangulates one of the motions that a plane allows, and accepts it under the same conditions on
/// its points and their parallax.
TwoViewResult TriangulatePlanarMotion(const std::vector<RayMatch>& matches,
                                      const PlanarMotion& motion,
                                      const InitializerOptions& options);

}  // namespace corvo
