#pragma once

#include <optional>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/map/map.h"

namespace corvo {

/// How far landmarks are from where the camera puts them.
struct MatchResiduals {
  int num_matches = 0;
  double median_px = 0;  ///< Of the input image.
};

/// Residuals of matches that nobody chose by their residual: the landmarks of each keyframe's most
/// covisible keyframes are projected into it and matched by descriptor within a wide window. (The
/// map's own observations have passed a test of their residual, and stay small whatever the
/// camera.) None for a map without such matches.
std::optional<MatchResiduals> MeasureResiduals(const Map& map, const Camera& camera,
                                               const std::vector<double>& octave_scales);

/// The median of at least 100 matches is over 2 px: the calibration does not fit the pictures. A
/// small error, and any that a straight path makes up for, does not show.
bool IsImplausible(const MatchResiduals& residuals);

}  // namespace corvo
