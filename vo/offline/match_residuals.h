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
  int num_parts = 4;         ///< Consecutive parts of the keyframes that are judged separately.
  int min_matches = 100;     ///< With fewer matches no median is implausible.
  double max_median_px = 2;  ///< A larger median is implausible; times orb::ImageScale().
};

/// Distances between the projections of landmarks and their matched keypoints.
struct MatchResiduals {
  int num_matches = 0;
  double median_px = 0;      ///< Median without matches by chance, pixels of the input image.
  double least_part_px = 0;  ///< Least median of a part.
  double max_median_px = 2;  ///< A larger median of every part is implausible.
};

/// Returns the residuals of matches that were not selected by their residual: the landmarks of each
/// keyframe's most covisible keyframes are projected into it and matched by descriptor within a
/// wide window. (The map's own observations have passed a test of their residual, and remain small
/// for any camera.) Matches by chance, which are spread evenly over the windows, do not count in
/// the medians. Returns std::nullopt if there are no matches.
std::optional<MatchResiduals> MeasureResiduals(const Map& map,
                                               const MatchResidualOptions& options = {});

/// Returns whether the calibration does not fit the images: the median residual of every part is
/// too large. Blur or wrong matches affect only some parts. An error that the map compensates, such
/// as a wrong focal length, is not detected; see CheckCalibration().
bool IsImplausible(const MatchResiduals& residuals, const MatchResidualOptions& options = {});

}  // namespace corvo
