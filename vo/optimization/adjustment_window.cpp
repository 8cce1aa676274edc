// SPDX-License-Identifier: MIT
#include "vo/optimization/adjustment_window.h"

#include <map>
#include <set>

namespace corvo {
namespace {

/// Adds the landmarks that the free keyframes observe, and the other keyframes that fix them.
AdjustmentWindow CompleteWindow(const Map& map, const std::set<KeyframeId>& free,
                                int min_shared_landmarks) {
  AdjustmentWindow window;
  window.free.assign(free.begin(), free.end());
  window.landmarks = map.FindObserved(window.free);
  std::map<KeyframeId, int> num_shared;
  for (const LandmarkId id : window.landmarks) {
    for (const TrackElement& element : map.FindLandmark(id)->track) {
      if (free.count(element.keyframe) == 0) ++num_shared[element.keyframe];
    }
  }
  for (const auto& [id, count] : num_shared) {
    if (count >= min_shared_landmarks) window.fixed.push_back(id);
  }
  return window;
}

}  // namespace

AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options) {
  std::set<KeyframeId> free{newest};
  for (const Covisible& covisible : map.FindCovisible(newest, options.min_shared_landmarks)) {
    if (static_cast<int>(free.size()) == options.max_keyframes) break;
    free.insert(covisible.keyframe);
  }
  return CompleteWindow(map, free, options.min_shared_landmarks);
}

AdjustmentWindow SelectNewestKeyframes(const Map& map, KeyframeId newest, int max_keyframes,
                                       const BundleAdjusterOptions& options) {
  std::set<KeyframeId> free;
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  for (auto id = active.rbegin(); id != active.rend(); ++id) {
    if (map.SegmentOf(*id) != map.SegmentOf(newest)) continue;
    free.insert(*id);
    if (static_cast<int>(free.size()) == max_keyframes) break;
  }
  return CompleteWindow(map, free, options.min_shared_landmarks);
}

}  // namespace corvo
