// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/offline/camera_path.h"

namespace corvo {

/// The height of the camera above the ground under its path, in units of the segment.
struct GroundHeight {
  /// The logarithm of the height at a place, and its standard deviation.
  struct AtPlace {
    double log_height = 0;
    double sigma = 0;
  };

  std::vector<AtPlace> places;  ///< By the places of the path.
  /// The angle about the direction of motion from the camera's y axis to the vertical, in rad.
  double roll = 0;
  /// The logarithm of the likelihood ratio of these heights and of no ground at all.
  double evidence = 0;
};

/// Finds the ground under a path from the points that the camera passed. The camera must be about
/// upright (within 5 degrees of roll; the pitch does not matter), and the ground must be the
/// surface of most points below it that are within twice its height to the left and right.
///
/// The logarithm of the height is a random walk along the path, since it has the drift of a
/// monocular scale. A point lies on the ground with a probability of one half and is anywhere
/// otherwise; the posterior comes from a discrete Bayes filter, forward and backward (Thrun,
/// Burgard and Fox, Probabilistic Robotics, chapter 4; Rabiner, A tutorial on hidden Markov models,
/// 1989). Returns std::nullopt unless the points are decisive evidence of a ground.
std::optional<GroundHeight> FindGround(const CameraPath& path,
                                       const std::vector<PassedPoint>& points);

}  // namespace corvo
