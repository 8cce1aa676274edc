#pragma once

#include <functional>
#include <vector>

#include "vo/core/options.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"

namespace corvo {

/// Removes recent landmarks that do not prove themselves: found in too small a share of the frames
/// that should see them, or seen by fewer than three keyframes after two more were made. `recent`
/// keeps those still on trial.
void CullLandmarks(Map& map, const KeyframeOptions& options, std::vector<LandmarkId>& recent);

/// Retires the keyframes covisible with `newest` whose landmarks are nearly all seen by at least
/// three other keyframes in the same or a finer octave, and returns them in ascending order. Keeps
/// the first keyframe of a segment.
std::vector<KeyframeId> CullKeyframes(Map& map, KeyframeId newest, const KeyframeOptions& options);

/// Archives the keyframes that nothing looks at any more: older than the `num_recent` newest that
/// are kept, and without a landmark of the newest. Returns the landmarks that left. Forgets merges
/// from before the `num_recent` newest keyframes of all. `leaving` is called with each keyframe
/// before it leaves.
std::vector<FinishedLandmark> ArchiveKeyframes(
    Map& map, int num_recent, const std::function<void(const Keyframe&)>& leaving = {});

}  // namespace corvo
