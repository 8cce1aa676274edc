#include "vo/mapping/keyframe_policy.h"

namespace corvo {

bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options) {
  return evidence.num_tracked < options.max_tracked_share * evidence.num_reference ||
         evidence.num_tracked < options.min_seeing_share * evidence.num_keypoints;
}

}  // namespace corvo
