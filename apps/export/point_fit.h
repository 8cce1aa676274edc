// SPDX-License-Identifier: MIT
#pragma once

#include "apps/export/reconstruction.h"

namespace corvo {

/// Moves each point to the least sum of its squared reprojection errors in pixels, with the poses
/// and the camera held fixed. Formats that store no standard deviations imply this cost; a run
/// weights observations and limits the influence of large errors.
void FitPointsToPixels(Reconstruction& reconstruction);

}  // namespace corvo
