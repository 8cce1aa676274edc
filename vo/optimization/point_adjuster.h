#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Minimizes the robust reprojection error (Huber) of each point of a bundle that is not in
/// `is_adjusted`, one entry a point, over its position; views and other points stay.
void AdjustPoints(const Camera& camera, const std::vector<char>& is_adjusted, Bundle& bundle);

}  // namespace corvo
