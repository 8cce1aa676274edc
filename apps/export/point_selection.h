// SPDX-License-Identifier: MIT
#pragma once

#include "apps/export/reconstruction.h"

namespace corvo {

/// The requirements for exported points and observations.
struct PointSelectionOptions {
  int min_keyframes = 3;                   ///< Least number of images that observe a point.
  double max_relative_depth_sigma = 0.05;  ///< Of its depth, relative to the depth.
  double max_error_sigmas = 3;             ///< Largest reprojection error, standard deviations.
};

/// Removes observations with larger reprojection errors, and then points that too few images
/// observe or whose depth is too uncertain, with their observations. The standard deviation of the
/// depth follows from those of the observations, with the poses and the camera held fixed: it is
/// that along the mean viewing direction, relative to the median depth.
void SelectPoints(const PointSelectionOptions& options, Reconstruction& reconstruction);

}  // namespace corvo
