// SPDX-License-Identifier: MIT
#include "vo/tracking/frame_matching.h"

#include "vo/map/guided_matching.h"

namespace corvo {
namespace {

std::vector<PredictedKeypoint> PredictRotated(const RotatedFrames& frames, const Camera& camera) {
  std::vector<PredictedKeypoint> predictions;
  for (int k = 0; k < frames.first.num_keypoints(); ++k) {
    const auto pixel =
        camera.Project(frames.second_from_first * frames.first.rays[k].homogeneous());
    if (pixel) predictions.push_back({k, k, *pixel});
  }
  return predictions;
}

}  // namespace

std::vector<orb::Match> MatchFrames(const Frame& first, const Frame& second,
                                    const FrameMatchingOptions& options) {
  const std::vector<orb::Nearest> forward =
      orb::FindNearest(first.features.descriptors, second.features.descriptors);
  const std::vector<orb::Nearest> backward =
      orb::FindNearest(second.features.descriptors, first.features.descriptors);
  const std::vector<orb::Nearest> distinct = orb::RatioTest(forward, options.max_ratio);
  const std::vector<orb::Match> near = orb::DistanceTest(distinct, options.max_distance);
  const std::vector<orb::Match> mutual = orb::CrossCheck(near, backward);
  return orb::KeepConsistentRotation(mutual, first.features.keypoints, second.features.keypoints);
}

std::vector<orb::Match> MatchRotatedFrames(const RotatedFrames& frames,
                                           const MeasurementModel& model, double radius_px,
                                           const FrameMatchingOptions& options) {
  const GuidedQueries queries =
      QueryKeypoints(frames.first, PredictRotated(frames, model.camera), radius_px, model);
  std::vector<orb::Match> matches = MatchGuided(
      queries, frames.second, {options.max_distance, RatioTest::kAnyOctave, options.max_ratio});
  for (orb::Match& match : matches) match.query = queries.ids[match.query];
  return matches;
}

}  // namespace corvo
