// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/options.h"
#include "vo/map/map.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Locates the active keyframes of a segment that are newer than those of a bundle, which has been
/// adjusted to a new camera and written back. In ascending order, each is located by the landmarks
/// of the bundle and of the keyframes before it that it observes, and its other landmarks move
/// with it. A keyframe with fewer inliers than a tracked frame needs moves with the one before it.
void LocateNewerKeyframes(const Bundle& adjusted, const OdometryOptions& options, Map& map);

}  // namespace corvo
