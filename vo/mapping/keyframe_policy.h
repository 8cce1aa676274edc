// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// The evidence from the images for the need of a keyframe.
struct KeyframeEvidence {
  int num_keypoints = 0;  ///< Keypoints of the frame.
  int num_tracked = 0;    ///< Keypoints of the frame that observe landmarks.
  /// Established landmarks of the keyframe that shares most with the frame: those observed by at
  /// least three keyframes, or by two while the segment has only two.
  int num_reference = 0;
};

/// Returns the evidence for a frame that was tracked in the map.
KeyframeEvidence CollectEvidence(const Map& map, const Frame& frame);

/// Returns whether a keyframe is due: the frame observes clearly fewer landmarks than the nearest
/// keyframe, or few for its number of keypoints. If few landmarks live long enough to be
/// established, as in a fast turn, the former alone would wait until tracking is lost. Depends only
/// on image evidence, not on time or on other threads.
bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options);

}  // namespace corvo
