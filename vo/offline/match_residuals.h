// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/map/map.h"

namespace corvo {

/// Which matches are measured, and what is implausible.
struct MatchResidualOptions {
  int max_keyframes = 10;        ///< Covisible keyframes whose landmarks are projected.
  double search_radius_px = 60;  ///< Around a projection, px of its octave.
  int max_distance = 65;         ///< Between descriptors, bits.
  int min_matches = 100;         ///< With fewer nothing is implausible.
  double max_median_px = 2;      ///< A larger median is implausible.
};

/// How far landmarks are from where the camera puts them.
struct MatchResiduals {
  int num_matches = 0;
  double median_px = 0;  ///< Of the input image.
};

/// Residuals of matches that nobody selected by their residual: the landmarks of each keyframe's
/// most covisible keyframes are projected into it and matched by descriptor within a wide window.
/// (The map's own observations have passed a test of their residual, and stay small whatever the
/// camera.) None for a map without such matches.
std::optional<MatchResiduals> MeasureResiduals(const Map& map,
                                               const MatchResidualOptions& options = {});

/// Whether the calibration does not fit the images: the median of enough matches is too large. A
/// small error, and any that a straight path makes up for, does not show.
bool IsImplausible(const MatchResiduals& residuals, const MatchResidualOptions& options = {});

}  // namespace corvo
