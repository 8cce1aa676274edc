// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/map/map.h"

namespace corvo {

/// Options of MeasureResiduals() and IsImplausible().
struct MatchResidualOptions {
  int max_keyframes = 10;        ///< Covisible keyframes whose landmarks are projected.
  double search_radius_px = 60;  ///< Radius around a projection, px of its octave.
  int max_distance = 65;         ///< Largest descriptor distance, bits.
  double max_ratio =
      0.8;  ///< Of the distances to the best and second best match: a match must be unique.
  int min_matches = 100;     ///< With fewer matches no median is implausible.
  double max_median_px = 2;  ///< A larger median is implausible; times orb::ImageScale().
};

/// Distances between the projections of landmarks and their matched keypoints.
struct MatchResiduals {
  int num_matches = 0;
  double median_px = 0;      ///< Median in pixels of the input image.
  double max_median_px = 2;  ///< A larger median is implausible.
};

/// Returns the residuals of matches that were not selected by their residual: the landmarks of each
/// keyframe's most covisible keyframes are projected into it and matched by descriptor within a
/// wide window. (The map's own observations have passed a test of their residual, and remain small
/// for any camera.) Returns std::nullopt if there are no matches.
std::optional<MatchResiduals> MeasureResiduals(const Map& map,
                                               const MatchResidualOptions& options = {});

/// Returns whether the calibration does not fit the images: the median of enough matches is too
/// large. A small error, and any error that a straight path compensates, is not detected.
bool IsImplausible(const MatchResiduals& residuals, const MatchResidualOptions& options = {});

}  // namespace corvo
