// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "orb/kernels/moments.h"

namespace corvo::orb::kernels {

/// Directions of the vectors (x, y) in degrees, [0, 360), from the x axis towards the y axis; 0 for
/// the null vector. Within 1e-5 degrees of the truth before rounding to float, and free of libm.
/// The spans are of one size.
void FindDirectionsDeg(std::span<const DiscMoments> moments, std::span<float> directions_deg);

namespace scalar {
float DirectionDeg(double x, double y);
void FindDirectionsDeg(std::span<const DiscMoments> moments, std::span<float> directions_deg);
}  // namespace scalar

}  // namespace corvo::orb::kernels
