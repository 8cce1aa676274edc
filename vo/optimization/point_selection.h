// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/optimization/bundle.h"

namespace corvo {

/// Returns for each point whether it is selected. The selected points determine the views of a
/// bundle nearly as well as all points: in descending order of track length, a point is selected if
/// it is observed by a free view that has fewer than `points_per_view` selected points so far.
std::vector<char> SelectPoints(const Bundle& bundle, int points_per_view);

/// Returns a bundle reduced to the points of SelectPoints(), so that the size of an adjustment
/// grows only with the number of views. Points observed by fewer than two views are removed, too.
Bundle ThinPoints(const Bundle& bundle, int points_per_view);

}  // namespace corvo
