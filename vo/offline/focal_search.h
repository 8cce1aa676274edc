// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// A point observed in two images of one camera; px.
struct PixelMatch {
  Eigen::Vector2d first;
  Eigen::Vector2d second;
  double sigma = 1;  ///< Standard deviation of both pixels along each axis, up to a factor common
                     ///< to all matches.
};

/// The matches of one pair of images.
using PixelMatches = std::vector<PixelMatch>;

/// A focal length that was tried.
struct FocalCandidate {
  double focal = 0;    ///< px
  double fov_deg = 0;  ///< Horizontal field of view.
  double cost = 0;     ///< Robust χ² of all pairs.
};

/// The camera estimated from images without a calibration.
struct FocalSearchResult {
  CameraParameters camera;  ///< Pinhole, fx = fy, principal point in the center, no distortion.
  /// Standard deviation of the focal length as a share of it; infinity if the pairs do not
  /// constrain it.
  double focal_sigma = std::numeric_limits<double>::infinity();
  bool is_determined = false;         ///< The cost has one clear minimum inside the sweep.
  int num_pairs = 0;                  ///< Number of pairs with enough matches.
  std::vector<FocalCandidate> sweep;  ///< From the longest focal length to the shortest.
};

/// Options of SearchFocal().
struct FocalSearchOptions {
  double min_fov_deg = 25;
  double max_fov_deg = 120;
  double unknown_fov_deg = 70;  // A phone's main camera.
  int num_coarse = 27;          // Focal lengths about 8% apart.
  int num_fine = 4;
  int min_matches = 30;         // ablation
  double max_error_px = 2;      // ablation
  double max_error_sigmas = 3;  // Three standard deviations.
  double max_rotation_excess =
      0.6;                  // Between the values at parallaxes of 0 and 1 sigma; see SearchFocal.
  double max_sigma = 0.15;  // ablation
  double useless_sigma = 0.5;  // The range of fields of view spans 1.1 either side of its middle.

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_fov_deg", self.min_fov_deg, 1.0, 170.0,
          "least horizontal field of view that is tried, degrees");
    field("max_fov_deg", self.max_fov_deg, 1.0, 170.0,
          "largest horizontal field of view that is tried, degrees");
    field("unknown_fov_deg", self.unknown_fov_deg, 1.0, 170.0,
          "horizontal field of view assumed where the images tell nothing, degrees");
    field("num_coarse", self.num_coarse, 5, 1000, "focal lengths of the first sweep");
    field("num_fine", self.num_fine, 1, 1000,
          "focal lengths of the second sweep on either side of the best of the first");
    field("min_matches", self.min_matches, 8, 100000, "least number of matches of a pair");
    field("max_error_px", self.max_error_px, 0.1, 100.0,
          "inlier threshold of the fundamental matrix, px");
    field("max_error_sigmas", self.max_error_sigmas, 0.1, 100.0,
          "largest Sampson error of a match, in its standard deviations");
    field("max_rotation_excess", self.max_rotation_excess, 0.0, 100.0,
          "cost of a match by which a rotation may be worse than a motion and is still preferred");
    field("max_sigma", self.max_sigma, 1e-6, 10.0,
          "standard deviation up to which the focal length is determined, as a share of it");
    field("useless_sigma", self.useless_sigma, 1e-6, 10.0,
          "standard deviation from which the result is not used, as a share of the focal length");
  }

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// Searches for the focal length of the pinhole camera that explains pairs of images best, by a
/// sweep over horizontal fields of view and a finer one around the best. The cost of a pair is that
/// of the best motion that the focal length allows: the robust Sampson error of an essential matrix
/// or, if the camera only rotated (Torr's GRIC, 1998), the robust transfer error of a rotation. Two
/// views with a known principal point determine their focal length unless their axes are parallel
/// or meet symmetrically (Sturm, "On focal length calibration from two views", 2001), the camera
/// moves straight along its axis, or the scene is a plane: the cost of such pairs is constant. The
/// sigma is derived from the curvature of the cost and the inconsistency of the pairs. The best
/// camera is returned even if it is not determined, but the camera with the unknown field of view
/// if the sigma is useless, the best lies at an end of the sweep, or no pair has enough matches.
/// Throws corvo::Error if an option or a size is out of range.
FocalSearchResult SearchFocal(const std::vector<PixelMatches>& pairs, int width, int height,
                              const FocalSearchOptions& options = {});

}  // namespace corvo
