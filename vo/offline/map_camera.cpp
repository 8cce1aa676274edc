// SPDX-License-Identifier: MIT
#include "vo/offline/map_camera.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace corvo {

std::vector<KeyframeGroup> SplitKeyframes(const Map& map, int num_groups, int min_keyframes) {
  std::map<int, KeyframeGroup> segments;
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  for (const KeyframeId id : active) segments[map.SegmentOf(id)].push_back(id);
  std::vector<KeyframeGroup> groups;
  for (const auto& [segment, keyframes] : segments) {
    const auto size = static_cast<std::ptrdiff_t>(keyframes.size());
    const double share = static_cast<double>(size) / static_cast<double>(active.size());
    const std::ptrdiff_t most = std::max<std::ptrdiff_t>(1, size / min_keyframes);
    const std::ptrdiff_t count =
        std::clamp<std::ptrdiff_t>(std::lround(share * num_groups), 1, most);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      groups.emplace_back(keyframes.begin() + i * size / count,
                          keyframes.begin() + (i + 1) * size / count);
    }
  }
  std::erase_if(groups, [&](const KeyframeGroup& group) {
    return static_cast<int>(group.size()) < min_keyframes;
  });
  return groups;
}

AdjustmentSummary AdjustMapCamera(const Map& map, const std::vector<KeyframeGroup>& groups,
                                  const CameraPrior& prior, double information_factor) {
  std::vector<Bundle> bundles;
  int num_keyframes = 0;
  for (const KeyframeGroup& group : groups) {
    bundles.push_back(CopyBundle(map, {group, {}, map.FindObserved(group)}));
    num_keyframes += static_cast<int>(group.size());
  }
  AdjustmentOptions adjustment = CalibrationAdjustment(CalibrationOptions(), num_keyframes);
  adjustment.information_factor = information_factor;
  adjustment.num_rounds = 2;
  adjustment.max_iterations = 20;
  return BundleAdjuster(adjustment).Adjust(prior, map.camera().parameters(), bundles);
}

}  // namespace corvo
