#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

/// Keypoints of a frame and where to look for them in another.
struct Queries {
  std::vector<int> keypoint_ids;
  std::vector<orb::Keypoint> keypoints;
  std::vector<orb::Descriptor> descriptors;
  std::vector<orb::SearchWindow> windows;
};

Queries QueriesAfterRotation(const Frame& first, const SO3& second_from_first, const Camera& camera,
                             const std::vector<double>& octave_scales, double radius_px) {
  Queries queries;
  for (int k = 0; k < first.num_keypoints(); ++k) {
    const auto pixel = camera.Project(second_from_first * first.rays[k].homogeneous());
    if (!pixel || !camera.Contains(*pixel)) continue;
    const int octave = first.keypoint(k).octave;
    queries.keypoint_ids.push_back(k);
    queries.keypoints.push_back(first.keypoint(k));
    queries.descriptors.push_back(first.descriptor(k));
    queries.windows.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y()),
                               static_cast<float>(radius_px * octave_scales[octave]), octave - 1,
                               octave + 1});
  }
  return queries;
}

}  // namespace

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

std::vector<orb::Match> MatchRotatedFrames(const Frame& first, const Frame& second,
                                           const SO3& second_from_first, const Camera& camera,
                                           const std::vector<double>& octave_scales,
                                           double radius_px, const FrameMatchingOptions& options) {
  const Queries queries =
      QueriesAfterRotation(first, second_from_first, camera, octave_scales, radius_px);
  const std::vector<orb::Nearest> nearest = orb::FindNearestInWindows(
      queries.descriptors, queries.windows, second.features.descriptors, second.keypoint_index);
  const std::vector<orb::Nearest> distinct = orb::KeepDistinct(nearest, options.max_ratio);
  const std::vector<orb::Match> unique =
      orb::KeepUnique(orb::KeepNear(distinct, options.max_distance));
  std::vector<orb::Match> matches =
      orb::KeepConsistentRotation(unique, queries.keypoints, second.features.keypoints);
  for (orb::Match& match : matches) match.query = queries.keypoint_ids[match.query];
  return matches;
}

}  // namespace corvo
