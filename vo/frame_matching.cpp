#include "vo/frame_matching.h"

namespace corvo {

std::vector<orb::Match> MatchFrames(const Frame& first, const Frame& second,
                                    const FrameMatchingOptions& options) {
  const std::vector<orb::Nearest> forward =
      orb::FindNearest(first.features.descriptors, second.features.descriptors);
  const std::vector<orb::Nearest> backward =
      orb::FindNearest(second.features.descriptors, first.features.descriptors);
  const std::vector<orb::Nearest> distinct = orb::KeepDistinct(forward, options.max_ratio);
  const std::vector<orb::Match> near = orb::KeepNear(distinct, options.max_distance);
  const std::vector<orb::Match> mutual = orb::KeepMutual(near, backward);
  return orb::KeepConsistentRotation(mutual, first.features.keypoints, second.features.keypoints);
}

}  // namespace corvo
