#pragma once

#include "vo/options.h"

namespace corvo {

/// What the images say about the need for a keyframe.
struct KeyframeEvidence {
  int num_tracked = 0;  ///< Landmarks that the frame sees.
  int num_reference =
      0;  ///< Established landmarks of the keyframe that shares most with the frame.
};

/// A keyframe is due when the frame sees clearly less than the nearest keyframe. Depends on nothing
/// but image evidence: not on time, nor on what other threads are doing.
bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options);

}  // namespace corvo
