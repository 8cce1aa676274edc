#include "vo/mapping/culling.h"

#include <algorithm>

namespace corvo {
namespace {

enum class Verdict { kOnTrial, kKept, kCulled };

Verdict Judge(const Landmark& landmark, int num_keyframes, double min_found_share) {
  constexpr int kTrialKeyframes = 3;
  constexpr std::size_t kMinObservations = 3;
  if (landmark.num_found < min_found_share * landmark.num_visible) return Verdict::kCulled;
  const int age = num_keyframes - 1 - landmark.newest_keyframe;
  if (age >= 2 && landmark.observations.size() < kMinObservations) return Verdict::kCulled;
  return age >= kTrialKeyframes ? Verdict::kKept : Verdict::kOnTrial;
}

/// Seen by three or more other keyframes in the same or a finer octave (one coarser counts).
bool IsRedundant(const Map& map, const Landmark& landmark, KeyframeId keyframe, int octave) {
  constexpr int kMinOthers = 3;
  int num_others = 0;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe == keyframe) continue;
    const Frame& other = map.keyframe(o.keyframe).frame;
    num_others += other.keypoint(o.keypoint).octave <= octave + 1;
  }
  return num_others >= kMinOthers;
}

double RedundantShare(const Map& map, const Keyframe& keyframe) {
  int num_landmarks = 0;
  int num_redundant = 0;
  for (int k = 0; k < keyframe.frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(keyframe.frame.landmarks[k]);
    if (landmark == nullptr) continue;
    ++num_landmarks;
    num_redundant += IsRedundant(map, *landmark, keyframe.id, keyframe.frame.keypoint(k).octave);
  }
  return num_landmarks == 0 ? 1.0 : static_cast<double>(num_redundant) / num_landmarks;
}

bool IsFirstOfSegment(const Map& map, const Keyframe& keyframe) {
  return keyframe.id == 0 || map.SegmentOf(keyframe.id - 1) != keyframe.segment;
}

bool SharesLandmark(const Map& map, const Keyframe& keyframe, KeyframeId newest) {
  for (const LandmarkId id : keyframe.frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr && landmark->observations.back().keyframe == newest) return true;
  }
  return false;
}

}  // namespace

void CullLandmarks(Map& map, const KeyframeOptions& options, std::vector<LandmarkId>& recent) {
  std::vector<LandmarkId> on_trial;
  for (const LandmarkId id : recent) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    const Verdict verdict = Judge(*landmark, map.num_keyframes(), options.min_found_share);
    if (verdict == Verdict::kCulled) map.RemoveLandmark(id);
    if (verdict == Verdict::kOnTrial) on_trial.push_back(id);
  }
  recent = on_trial;
}

std::vector<KeyframeId> CullKeyframes(Map& map, KeyframeId newest, const KeyframeOptions& options) {
  std::vector<KeyframeId> candidates, retired;
  for (const Covisible& covisible : map.FindCovisible(newest)) {
    candidates.push_back(covisible.keyframe);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const KeyframeId id : candidates) {
    if (IsFirstOfSegment(map, map.keyframe(id))) continue;
    if (RedundantShare(map, map.keyframe(id)) <= options.max_redundant_share) continue;
    const std::vector<Covisible> neighbors = map.FindCovisible(id);
    if (neighbors.empty()) continue;
    map.RetireKeyframe(id, neighbors.front().keyframe);
    retired.push_back(id);
  }
  return retired;
}

std::vector<FinishedLandmark> ArchiveKeyframes(
    Map& map, int num_recent, const std::function<void(const Keyframe&)>& leaving) {
  map.ForgetMergesBefore(map.num_keyframes() - num_recent);
  const std::vector<KeyframeId> kept = map.KeptKeyframes();
  std::vector<FinishedLandmark> finished;
  if (static_cast<int>(kept.size()) <= num_recent) return finished;
  for (auto id = kept.begin(); id != kept.end() - num_recent; ++id) {
    if (SharesLandmark(map, map.keyframe(*id), kept.back())) continue;
    if (leaving) leaving(map.keyframe(*id));
    const std::vector<FinishedLandmark> left = map.ArchiveKeyframe(*id);
    finished.insert(finished.end(), left.begin(), left.end());
  }
  return finished;
}

}  // namespace corvo
