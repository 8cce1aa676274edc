// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

/// Removes landmarks on probation that do not prove themselves: found in too small a share of the
/// frames that should see them, or observed by too few keyframes by the end of their probation.
/// Afterwards `probation` holds those that are still on probation.
void CullLandmarks(const CullingOptions& options, std::vector<LandmarkId>& probation, Map& map);

/// Culls the keyframes covisible with `newest` whose landmarks are nearly all observed by enough
/// other keyframes in the same or a finer octave, and returns them in ascending order. Keeps the
/// first keyframe of a segment.
std::vector<KeyframeId> CullKeyframes(KeyframeId newest, const CullingOptions& options, Map& map);

/// Marginalizes the keyframes that nothing searches any more: older than the `num_recent` newest
/// active ones, and without a landmark of the newest. Returns the landmarks that left the map with
/// them. Forgets merges from before the `num_recent` newest keyframes of all. `before` is called
/// with each keyframe before it leaves.
std::vector<MarginalizedLandmark> MarginalizeKeyframes(
    int num_recent, const std::function<void(const Keyframe&)>& before, Map& map);

}  // namespace corvo
