// SPDX-License-Identifier: MIT
#pragma once

#include "vo/camera/camera.h"
#include "vo/core/adjustment_status.h"
#include "vo/optimization/bundle.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// Moves the free views and the points of a bundle, which were adjusted to the camera `before`, to
/// where the camera `after` sees the points most nearly in the same pixels. To first order, they
/// move as in an adjustment to the new camera of all that they were adjusted to. The noise of the
/// bundle's observations has no part in it, so that few points (AdjustmentOptions::points_per_view)
/// do. Then the observations over the 95% quantile of χ² are marked as outliers. The bundle is
/// unchanged unless the status is usable.
AdjustmentStatus MoveToCamera(const Camera& before, const Camera& after, AdjustmentOptions options,
                              Bundle& bundle);

}  // namespace corvo
