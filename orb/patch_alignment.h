// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "orb/patch.h"

namespace corvo::orb {

/// The linear map of an offset (x, y) in one patch to an offset in another: (a x + b y, c x + d y).
struct PatchWarp {
  float a = 1, b = 0, c = 0, d = 1;
};

/// A position in a patch, px from its center, and the quality of the fit.
struct PatchAlignment {
  float x = 0;
  float y = 0;
  float correlation = 0;  ///< Correlation coefficient of the two windows, -1 to 1.
};

/// Finds the position in `target` of the center of `reference`: the shift of an 8x8 window that
/// minimizes
///
///     sum over u of (I(u + shift) - g T(u) - b)²,   T(u) = reference(reference_from_target * u),
///
/// over the shift, a gain g and an offset b of the illumination, by inverse compositional
/// Gauss-Newton (Baker and Matthews, "Lucas-Kanade 20 years on", 2004). Returns std::nullopt if the
/// window has too little texture in some direction, the window leaves a patch, the gain is too low,
/// or the iteration does not converge.
std::optional<PatchAlignment> AlignPatch(const Patch& reference, const Patch& target,
                                         const PatchWarp& reference_from_target);

}  // namespace corvo::orb
