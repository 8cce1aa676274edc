// SPDX-License-Identifier: MIT
#include "vo/mapping/culling.h"

#include <algorithm>
#include <utility>

namespace corvo {
namespace {

enum class Verdict { kOnProbation, kAccepted, kCulled };

Verdict Judge(const Landmark& landmark, int num_keyframes, const CullingOptions& options) {
  if (landmark.num_found < options.min_found_share * landmark.num_visible) return Verdict::kCulled;
  const int age = num_keyframes - 1 - landmark.newest_keyframe;
  const int num_observations = static_cast<int>(landmark.track.size());
  const bool has_too_few = num_observations < options.min_observations;
  if (age >= options.min_observations_age && has_too_few) return Verdict::kCulled;
  return age >= options.num_probation_keyframes ? Verdict::kAccepted : Verdict::kOnProbation;
}

/// Returns whether enough other keyframes observe a landmark in the same or a finer octave (one
/// octave coarser counts as the same).
bool IsRedundant(const Map& map, const Landmark& landmark, const TrackElement& observation,
                 int num_observers) {
  const int octave = map.keyframe(observation.keyframe).frame.keypoint(observation.keypoint).octave;
  int num_others = 0;
  for (const TrackElement& o : landmark.track) {
    if (o.keyframe == observation.keyframe) continue;
    const Frame& other = map.keyframe(o.keyframe).frame;
    num_others += other.keypoint(o.keypoint).octave <= octave + 1;
  }
  return num_others >= num_observers;
}

double RedundantShare(const Map& map, const Keyframe& keyframe, int num_observers) {
  int num_landmarks = 0;
  int num_redundant = 0;
  for (int k = 0; k < keyframe.frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(keyframe.frame.landmarks[k]);
    if (landmark == nullptr) continue;
    ++num_landmarks;
    num_redundant += IsRedundant(map, *landmark, {keyframe.id, k}, num_observers);
  }
  return num_landmarks == 0 ? 1.0 : static_cast<double>(num_redundant) / num_landmarks;
}

/// Returns whether the keyframes before and after this one are of its segment.
bool IsInsideSegment(const Map& map, const Keyframe& keyframe) {
  const auto is_inside = [&](KeyframeId id) {
    return id >= 0 && id < map.num_keyframes() && map.SegmentOf(id) == keyframe.segment;
  };
  return is_inside(keyframe.id - 1) && is_inside(keyframe.id + 1);
}

bool SharesLandmark(const Map& map, const Keyframe& keyframe, KeyframeId newest) {
  for (const LandmarkId id : keyframe.frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr && landmark->track.back().keyframe == newest) return true;
  }
  return false;
}

}  // namespace

void CullLandmarks(const CullingOptions& options, std::vector<LandmarkId>& probation, Map& map) {
  std::vector<LandmarkId> remaining;
  for (const LandmarkId id : probation) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    const Verdict verdict = Judge(*landmark, map.num_keyframes(), options);
    if (verdict == Verdict::kCulled) map.RemoveLandmark(id);
    if (verdict == Verdict::kOnProbation) remaining.push_back(id);
  }
  probation = std::move(remaining);
}

void CullMaskedLandmarks(const cv::Mat& mask, Map& map) {
  for (const KeyframeId id : map.ActiveKeyframes()) {
    const Frame& frame = map.keyframe(id).frame;
    for (int k = 0; k < frame.num_keypoints(); ++k) {
      const LandmarkId landmark = frame.landmarks[k];
      if (landmark != kNoId && IsMasked(mask, frame.keypoint(k))) map.RemoveLandmark(landmark);
    }
  }
}

std::vector<KeyframeId> CullKeyframes(KeyframeId newest, const CullingOptions& options, Map& map) {
  std::vector<KeyframeId> candidates, culled;
  for (const Covisible& covisible : map.FindCovisible(newest)) {
    candidates.push_back(covisible.keyframe);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const KeyframeId id : candidates) {
    const Keyframe& keyframe = map.keyframe(id);
    if (!IsInsideSegment(map, keyframe)) continue;
    const double share = RedundantShare(map, keyframe, options.num_redundant_observers);
    if (share <= options.max_redundant_share) continue;
    const std::vector<Covisible> neighbors = map.FindCovisible(id);
    if (neighbors.empty()) continue;
    map.CullKeyframe(id, neighbors.front().keyframe);
    culled.push_back(id);
  }
  return culled;
}

std::vector<MarginalizedLandmark> MarginalizeKeyframes(
    int num_recent, const std::function<void(const Keyframe&)>& before, Map& map) {
  map.ForgetMergesBefore(map.num_keyframes() - num_recent);
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  std::vector<MarginalizedLandmark> finished;
  if (static_cast<int>(active.size()) <= num_recent) return finished;
  for (auto id = active.begin(); id != active.end() - num_recent; ++id) {
    if (SharesLandmark(map, map.keyframe(*id), active.back())) continue;
    if (before) before(map.keyframe(*id));
    const std::vector<MarginalizedLandmark> left = map.MarginalizeKeyframe(*id);
    finished.insert(finished.end(), left.begin(), left.end());
  }
  return finished;
}

}  // namespace corvo
