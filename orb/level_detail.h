// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "orb/pyramid.h"

namespace corvo::orb {

/// Returns the first pyramid level that shows detail of its own. The detail of a level is the ratio
/// of its root mean square gradient per pixel to that of the first level of at most half its size.
/// It is about 1 in sharp photographs, whose gradients are similar at all scales (Field, "Relations
/// between the statistics of natural images", 1987), at least 0.7 for sharp step edges however
/// sparse they are, and 0.5 in images that were enlarged or blurred, which show at half the size
/// the same as at full size. Levels with a detail below `min_detail` are skipped, as long as there
/// is a level of half their size.
int FindFirstDetailedLevel(const std::vector<PyramidLevel>& levels, double min_detail);

}  // namespace corvo::orb
