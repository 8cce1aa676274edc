// SPDX-License-Identifier: MIT
#pragma once

#include "vo/optimization/pose_dependence.h"

namespace corvo {

/// The measured variance of image measurements in units of the assumed one: the running mean of the
/// squared errors of the inliers of newest frames, for aligned and for merely detected keypoints.
/// The standard deviations of MeasurementOptions are the widths of gates; those of the errors are
/// smaller by the square root of this factor.
class VarianceFactor {
 public:
  /// Adds the errors of a frame.
  void Add(const PoseDependence& frame);

  /// Returns the mean factor of a frame's keypoints; 1 before the first frame.
  double Of(const PoseDependence& frame) const;

  double aligned() const { return aligned_.value; }
  double detected() const { return detected_.value; }

 private:
  struct Mean {
    double value = 1;
    bool is_known = false;

    void Add(const SquaredErrors& errors);
  };

  Mean aligned_, detected_;
};

}  // namespace corvo
