// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "orb/matcher.h"
#include "vo/lie/se3.h"
#include "vo/map/map.h"

namespace corvo {

/// Where and how a landmark should appear in a frame.
struct LandmarkView {
  Eigen::Vector2d pixel;
  double view_cosine = 1;  ///< Of the angle between this and the landmark's mean view direction.
  int octave = 0;          ///< In which it should be detected.

  orb::SearchWindow Window(double radius_px, int octaves_below, int octaves_above) const;
};

/// None if the landmark lies behind the camera or outside the image, at a distance from which no
/// octave shows it, or is seen from more than 60 degrees beside its mean view direction.
std::optional<LandmarkView> ProjectLandmark(const Landmark& landmark, const SE3& world_from_camera,
                                            const MeasurementModel& model);

}  // namespace corvo
