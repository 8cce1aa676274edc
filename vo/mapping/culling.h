// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

/// Removes landmarks that fail their probation: those found in too small a share of the frames in
/// which they should be visible, or observed by too few keyframes at the age
/// `min_observations_age`. Afterwards `probation` holds those that are still on probation.
void CullLandmarks(const CullingOptions& options, std::vector<LandmarkId>& probation, Map& map);

/// Removes the landmarks that active keyframes observe where `mask`, 8-bit and of the image's size,
/// is zero.
void CullMaskedLandmarks(const cv::Mat& mask, Map& map);

/// Culls the keyframes covisible with `newest` whose landmarks are nearly all observed by enough
/// other keyframes in the same or a finer octave, and returns them in ascending order. The first
/// and the last of consecutive keyframes of one segment are never culled.
std::vector<KeyframeId> CullKeyframes(KeyframeId newest, const CullingOptions& options, Map& map);

/// Marginalizes the keyframes that are no longer searched: those that are older than the
/// `num_recent` newest active ones and share no landmark with the newest. Calls `before` with each
/// keyframe before it is removed. Forgets merges from before the `num_recent` newest keyframes,
/// active or not. Returns the landmarks that are removed with the keyframes.
std::vector<MarginalizedLandmark> MarginalizeKeyframes(
    int num_recent, const std::function<void(const Keyframe&)>& before, Map& map);

}  // namespace corvo
