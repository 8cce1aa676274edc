// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "orb/matcher.h"
#include "vo/lie/se3.h"
#include "vo/map/map.h"

namespace corvo {

/// The expected appearance of a landmark in a frame.
struct LandmarkView {
  Eigen::Vector2d pixel;
  double view_cosine = 1;  ///< Cosine of the angle to the landmark's mean view direction.
  int octave = 0;          ///< Octave in which it should be detected.

  orb::SearchWindow Window(double radius_px, int octaves_below, int octaves_above) const;
};

/// Returns std::nullopt if the landmark lies behind the camera or outside the image, if no octave
/// shows it at this distance (within `distance_tolerance`), or if the angle to its mean view
/// direction is too large (`min_view_cosine`).
std::optional<LandmarkView> ProjectLandmark(const Landmark& landmark, const SE3& world_from_camera,
                                            const MeasurementModel& model);

}  // namespace corvo
