// SPDX-License-Identifier: MIT
#pragma once

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/map/pose_graph.h"
#include "vo/offline/map_camera.h"

namespace corvo {

/// Options of CheckCalibration().
struct CalibrationCheckOptions {
  int num_parts = 4;
  int min_keyframes = 3;         ///< Smallest part.
  double focal_sigma = 0.5;      ///< Prior, relative: nearly unknown.
  double min_difference = 0.03;  ///< A part fits another focal length from this difference on.
  double min_sigmas = 4.2;     ///< Of the weighted mean of the parts that agree: 3 for each of two.
  double max_part_sigmas = 4;  ///< Most that one part counts.
  double max_disagreement = 0.5;  ///< Of a part with the median, as a share of the median.
  double min_median = 0.05;       ///< A smaller median difference is not implausible.
};

/// The focal lengths that fit disjoint parts of a sequence best.
struct CalibrationCheck {
  int num_parts = 0;     ///< Parts whose adjustment is usable.
  int num_agreeing = 0;  ///< Parts that fit another focal length, and agree on it.
  double focal_px = 0;   ///< Median of the parts, as fx; 0 without parts.
  bool is_implausible = false;
};

/// Estimates the focal length from consecutive parts of a map's active keyframes, each alone, with
/// the prior of MakePrior() for all other parameters. The
/// calibration is implausible if at least half of the parts, and two, agree with the median of all
/// on another focal length, and contradict the given one together: a single part never does. Wrong
/// matches on a repetitive texture contradict a correct calibration, too, but differently in each
/// part. Motion and scenes that do not determine the focal length contradict nothing.
CalibrationCheck CheckCalibration(const Map& map, const CalibrationCheckOptions& options = {});

/// Raises the variance of the focal length in a graph, if the calibration that its poses have is
/// implausible: to the square of its difference from the focal length that fits the parts. `prior`
/// has the free parameters of the camera, `fx` is its focal length.
void WidenFocalLength(const CalibrationCheck& check, const CameraPrior& prior, double fx,
                      PoseGraph& graph);

}  // namespace corvo
