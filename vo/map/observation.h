// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/core/conventions.h"

namespace corvo {

/// A landmark observed in an image: the type of all measurements, from matching to bundle
/// adjustment.
struct Observation {
  LandmarkId landmark = kNoId;
  int keypoint = kNoId;                             ///< Index in its frame; kNoId if unknown.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< Position in the input image.
  double sigma_px = 1;                              ///< Standard deviation along each axis.

  bool operator==(const Observation&) const = default;
};

}  // namespace corvo
