// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/optimization/bundle.h"

namespace corvo {

/// Points that determine the views of a bundle nearly as well as all of them do: point by point,
/// the longest tracks first, each that a free view observes which has fewer than `points_per_view`
/// of them so far. One entry for each point.
std::vector<char> SelectPoints(const Bundle& bundle, int points_per_view);

/// What is left of a bundle when only the points of SelectPoints are kept, so that the size of an
/// adjustment grows with the number of views alone; points observed by fewer than two views go,
/// too.
Bundle ThinPoints(const Bundle& bundle, int points_per_view);

}  // namespace corvo
