// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/optimization/bundle.h"

namespace corvo {

struct PointAdjustmentOptions {
  double huber_sigmas = 1;  ///< Residual at which Huber's loss becomes linear.
  int max_iterations = 5;
};

/// Minimizes the robust reprojection error (Huber) of each point of a bundle for which
/// `is_adjusted`, with one entry for each point, is 0. Only the point's position is free; views and
/// other points are constant.
void AdjustPoints(const Camera& camera, const std::vector<char>& is_adjusted,
                  const PointAdjustmentOptions& options, Bundle& bundle);

}  // namespace corvo
