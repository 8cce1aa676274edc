#pragma once

#include <vector>

#include "vo/optimization/bundle.h"

namespace corvo {

/// Points that determine the views of a bundle as well as all of them nearly do: point by point,
/// those in most views first, each that a free view sees which has fewer than `points_per_view`
/// of them so far. One entry a point.
std::vector<char> SelectPoints(const Bundle& bundle, int points_per_view);

}  // namespace corvo
