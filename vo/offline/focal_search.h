#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// The same point in two images of one camera, and its standard deviation in each; px.
struct PixelMatch {
  Eigen::Vector2d first;
  Eigen::Vector2d second;
  double sigma = 1;  ///< Of either pixel, each axis, but for a factor that all matches share.
};

/// One pair of images.
using PixelMatches = std::vector<PixelMatch>;

/// A focal length that was tried.
struct FocalCandidate {
  double focal = 0;    ///< px
  double fov_deg = 0;  ///< Horizontal field of view.
  double cost = 0;     ///< Robust χ² of all pairs.
};

/// What images without a calibration tell of their camera.
struct FocalSearchResult {
  CameraParameters camera;  ///< Pinhole, fx = fy, principal point in the center, no distortion.
  /// Standard deviation of the focal length as a share of it; infinity where the pairs tell
  /// nothing.
  double focal_sigma = std::numeric_limits<double>::infinity();
  bool is_determined = false;         ///< The cost has one clear minimum inside the sweep.
  int num_pairs = 0;                  ///< That had enough matches.
  std::vector<FocalCandidate> sweep;  ///< From the longest focal length to the shortest.
};

/// The focal length of the pinhole camera that explains pairs of images best: a sweep over
/// horizontal fields of view from 25 to 120 degrees, and a finer one around the best. The cost of a
/// pair is that of the best motion that the focal length allows: the robust Sampson error of an
/// essential matrix or, where the camera did not move but turned (Torr's GRIC, 1998), the robust
/// transfer error of a rotation. Two views with a known center tell their focal length unless their
/// axes are parallel or meet symmetrically (Sturm, "On focal length calibration from two views",
/// 2001), the camera goes straight along its axis, or the scene is a plane: such pairs add a
/// constant. The sigma comes from the curvature and from how much the pairs contradict one another.
/// The best camera is given even where it is not determined, but one 70 degrees wide where its
/// sigma is over 0.5, the best lies at an end of the sweep, or no pair has 30 matches. Throws
/// corvo::Error on a size out of a camera's range.
FocalSearchResult SearchFocal(const std::vector<PixelMatches>& pairs, int width, int height);

}  // namespace corvo
