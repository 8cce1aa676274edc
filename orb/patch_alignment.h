// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "orb/patch.h"

namespace corvo::orb {

/// Where a step in one patch leads in another: (a x + b y, c x + d y).
struct PatchWarp {
  float a = 1, b = 0, c = 0, d = 1;
};

/// A place in a patch, px from its middle, and how well it fits.
struct PatchAlignment {
  float x = 0;
  float y = 0;
  float correlation = 0;  ///< Of the two patches there, -1 to 1.
};

/// Where in `target` the middle of `reference` lies: the shift of an 8x8 window that minimizes
///
///     sum over u of (I(u + shift) - g T(u) - b)²,   T(u) = reference(reference_from_target * u),
///
/// whatever gain g and offset b the light makes, by inverse compositional Gauss-Newton (Baker and
/// Matthews, "Lucas-Kanade 20 years on", 2004). None where the window has no texture in some
/// direction, leaves a patch, or does not come to rest.
std::optional<PatchAlignment> AlignPatch(const Patch& reference, const Patch& target,
                                         const PatchWarp& reference_from_target);

}  // namespace corvo::orb
