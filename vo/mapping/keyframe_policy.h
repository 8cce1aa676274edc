// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// What the images say about the need for a keyframe.
struct KeyframeEvidence {
  int num_keypoints = 0;  ///< Of the frame.
  int num_tracked = 0;    ///< Of them, those that observe landmarks.
  /// Established landmarks of the keyframe that shares most with the frame: those that at least
  /// three keyframes observe, or two while the segment has no more keyframes.
  int num_reference = 0;
};

/// The evidence for a frame that was tracked in the map.
KeyframeEvidence CollectEvidence(const Map& map, const Frame& frame);

/// A keyframe is due when the frame observes clearly less than the nearest keyframe, or little:
/// where few landmarks live long enough to be established, as in a fast turn, the former alone
/// would wait until the track is lost. Depends on nothing but image evidence: not on time, nor on
/// what other threads are doing.
bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options);

}  // namespace corvo
