// SPDX-License-Identifier: MIT
#pragma once

#include "orb/patch.h"

namespace corvo::orb {

/// Returns the smaller eigenvalue of the structure tensor, as a share of the larger one:
///
///     M = sum over 9x9 pixels of g g^T,
///
/// where g is the gradient by central differences. The share is about 0 on a straight edge, along
/// which a match may slide, and 1 where all directions have equal texture; it does not depend on
/// contrast (Shi and Tomasi, "Good features to track", 1994). A patch without texture has 0.
double EigenvalueShare(const Patch& patch);

}  // namespace corvo::orb
