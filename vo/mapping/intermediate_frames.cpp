// SPDX-License-Identifier: MIT
#include "vo/mapping/intermediate_frames.h"

#include <algorithm>
#include <utility>

namespace corvo {
namespace {

/// The observations of each point of a bundle that are to be added to it.
using AddedObservations = std::vector<std::vector<Bundle::Observation>>;

/// Adds what a view observes of the points of a bundle.
void AddObservations(const std::vector<Observation>& observations, int view, const Map& map,
                     const Bundle& bundle, AddedObservations& added) {
  for (Observation observation : observations) {
    observation.landmark = map.Resolve(observation.landmark);
    const int point = FindPoint(bundle, observation.landmark);
    if (point == kNoId) continue;
    // Two landmarks that the frame observed may have been merged.
    const bool is_observed = !added[point].empty() && added[point].back().view == view;
    if (!is_observed) added[point].push_back({observation, view, point});
  }
}

/// Inserts the observations after those of the same point.
void Insert(const AddedObservations& added, Bundle& bundle) {
  const std::vector<int> offsets = ObservationOffsets(bundle);
  const auto first = bundle.observations.begin();
  std::vector<Bundle::Observation> all;
  for (std::size_t point = 0; point < added.size(); ++point) {
    all.insert(all.end(), first + offsets[point], first + offsets[point + 1]);
    all.insert(all.end(), added[point].begin(), added[point].end());
  }
  bundle.observations = std::move(all);
}

}  // namespace

void IntermediateFrames::Add(const Frame& frame, int segment, const Map& map) {
  if (per_keyframe_ == 0) return;
  constexpr int kMaxFollowing = 30;  // While the camera stands still, no keyframe follows.
  const KeyframeId newest = map.num_keyframes() - 1;
  if (map.SegmentOf(newest) != segment || map.keyframe(newest).frame.index == frame.index) return;
  while (!frames_.empty() && frames_.front().keyframe <= newest - num_keyframes_) {
    frames_.pop_front();
  }
  if (std::ranges::count(frames_, newest, &PosedFrame::keyframe) >= kMaxFollowing) return;
  PosedFrame added{newest, map.WorldFromKeyframe(newest).Inverse() * frame.world_from_camera, {}};
  added.observations.reserve(static_cast<std::size_t>(CountObservedLandmarks(frame)));
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) added.observations.push_back(Observe(frame, k, map.model()));
  }
  frames_.push_back(std::move(added));
}

std::size_t IntermediateFrames::num_bytes() const {
  std::size_t bytes = 0;
  for (const PosedFrame& frame : frames_) {
    bytes += sizeof(PosedFrame) + frame.observations.size() * sizeof(Observation);
  }
  return bytes;
}

void IntermediateFrames::AddTo(const Map& map, Bundle& bundle) const {
  if (frames_.empty()) return;
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  const std::vector<Bundle::View> keyframes = bundle.views;
  AddedObservations added(bundle.points.size());
  for (const Bundle::View& view : keyframes) {
    if (view.is_fixed) continue;
    for (const PosedFrame* frame : Select(view.keyframe)) {
      const SE3 world_from_camera =
          map.WorldFromKeyframe(view.keyframe) * frame->keyframe_from_camera;
      AddObservations(frame->observations, static_cast<int>(bundle.views.size()), map, bundle,
                      added);
      bundle.views.push_back({kNoId, false, (local_from_world * world_from_camera).data()});
    }
  }
  Insert(added, bundle);
}

void IntermediateFrames::RemoveFrom(Bundle& bundle) {
  std::erase_if(bundle.views, [](const Bundle::View& view) { return view.keyframe == kNoId; });
  const int num_keyframes = static_cast<int>(bundle.views.size());
  std::erase_if(bundle.observations, [&](const Bundle::Observation& observation) {
    return observation.view >= num_keyframes;
  });
}

std::vector<const IntermediateFrames::PosedFrame*> IntermediateFrames::Select(
    KeyframeId keyframe) const {
  const auto first = std::ranges::lower_bound(frames_, keyframe, {}, &PosedFrame::keyframe);
  const auto end = std::ranges::upper_bound(frames_, keyframe, {}, &PosedFrame::keyframe);
  const int num_following = static_cast<int>(end - first);
  const int num_selected = std::min(per_keyframe_, num_following);
  std::vector<const PosedFrame*> selected;
  for (int i = 0; i < num_selected; ++i) {
    selected.push_back(&first[(2 * i + 1) * num_following / (2 * num_selected)]);
  }
  return selected;
}

}  // namespace corvo
