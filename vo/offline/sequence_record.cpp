// SPDX-License-Identifier: MIT
#include "vo/offline/sequence_record.h"

#include <algorithm>

#include "orb/error.h"
#include "vo/offline/log_check.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

/// Returns at most `max_count` of the elements, evenly spread.
std::vector<FrameKey> Spread(const std::vector<FrameKey>& elements, int max_count) {
  const auto size = static_cast<long>(elements.size());
  if (size <= max_count) return elements;
  std::vector<FrameKey> spread;
  for (long i = 0; i < max_count; ++i) {
    spread.push_back(elements[(2 * i + 1) * size / (2 * max_count)]);
  }
  return spread;
}

/// Returns the pose of an adjusted keyframe. Its frame may have been posed in another segment
/// first; if the two were joined, that pose remains.
SE3 PoseOf(KeyframeId keyframe, const Map& map, const FrameResult& frame) {
  const bool is_posed_before = !frame.is_keyframe && frame.segment == map.SegmentOf(keyframe);
  return is_posed_before ? *frame.world_from_camera : map.WorldFromKeyframe(keyframe);
}

/// An observation and its view in a bundle.
struct Entry {
  Observation observation;
  int view;
};

/// Adds points and observations to a bundle whose views are set.
void AddPoints(const std::unordered_map<LandmarkId, Eigen::Vector3d>& in_world,
               std::vector<Entry> entries, Bundle& bundle) {
  const auto key = [](const Entry& e) { return std::pair(e.observation.landmark, e.view); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [observation, view] = entries[i];
    if (i > 0 && key(entries[i]) == key(entries[i - 1])) continue;  // Both are of merged landmarks.
    if (bundle.points.empty() || bundle.points.back().landmark != observation.landmark) {
      bundle.points.push_back(
          {observation.landmark, local_from_world * in_world.at(observation.landmark)});
    }
    bundle.observations.push_back({observation, view, static_cast<int>(bundle.points.size()) - 1});
  }
}

}  // namespace

SequenceRecord::SequenceRecord(const Odometry& odometry, const ObservationLog& log,
                               const SequenceOptions& options)
    : options_(options) {
  CheckRange("frames_between", options.frames_between, 0, 1'000'000);
  CheckRange("max_frames", options.max_frames, 1, 1'000'000'000);
  CheckRange("max_points", options.max_points, 1, 1'000'000'000);
  const Map& map = odometry.map();
  const Trajectory trajectory = odometry.GetTrajectory();
  CheckLog(odometry, trajectory, log);
  std::set<FrameKey> others;
  const auto keep = [&](const FrameObservations& seen) {
    // The odometry may have discarded the poses of a frame and started anew.
    if (!trajectory.frames[seen.frame].world_from_camera) return;
    for (const LandmarkMerge& merge : seen.merges) merged_into_[merge.from] = merge.into;
    if (seen.keyframe == kNoId) {
      others.insert({trajectory.frames[seen.frame].segment, seen.frame});
    } else if (!map.IsCulled(seen.keyframe)) {
      AddKeyframe(seen, map, trajectory);
    }
  };
  log.Visit(keep);
  for (const KeyframeId id : map.ActiveKeyframes()) keep(ObservationsOf(map.keyframe(id), map));
  KeepLandmarks();
  const std::set<FrameKey> chosen = ChooseBetween(others);
  log.Visit([&](const FrameObservations& seen) {
    const FrameResult& frame = trajectory.frames[seen.frame];
    const FrameKey key{frame.segment, frame.index};
    if (seen.keyframe != kNoId || chosen.count(key) == 0) return;
    frames_[key] = {Finalize(seen, frame.segment), *frame.world_from_camera};
  });
}

LandmarkId SequenceRecord::Resolve(LandmarkId id) const {
  for (auto merged = merged_into_.find(id); merged != merged_into_.end();
       merged = merged_into_.find(id)) {
    id = merged->second;
  }
  return id;
}

void SequenceRecord::AddKeyframe(const FrameObservations& seen, const Map& map,
                                 const Trajectory& trajectory) {
  const int segment = map.SegmentOf(seen.keyframe);
  const auto [added, is_new] = frames_.try_emplace({segment, seen.frame});
  AdjustedFrame& frame = added->second;
  FrameObservations& all = frame.seen;
  if (is_new) {
    frame.world_from_camera = PoseOf(seen.keyframe, map, trajectory.frames[seen.frame]);
    all.frame = seen.frame;
    all.segment = segment;
    all.keyframe = seen.keyframe;
  }
  all.observations.insert(all.observations.end(), seen.observations.begin(),
                          seen.observations.end());
  for (const Eigen::Vector3d& in_world : seen.in_world) {
    const PointInSegment reported{seen.segment, in_world};
    all.in_world.push_back(ApplyJoins(map.joins(), seen.num_joins, reported).in_world);
  }
}

void SequenceRecord::KeepLandmarks() {
  for (auto& [key, frame] : frames_) {
    for (std::size_t i = 0; i < frame.seen.observations.size(); ++i) {
      LandmarkId& landmark = frame.seen.observations[i].landmark;
      landmark = Resolve(landmark);
      in_world_[landmark] = frame.seen.in_world[i];
    }
  }
}

std::set<FrameKey> SequenceRecord::ChooseBetween(const std::set<FrameKey>& others) const {
  const int num_keyframes = std::max(1, static_cast<int>(frames_.size()));
  const int num_between =
      std::clamp(options_.max_frames / num_keyframes - 1, 0, options_.frames_between);
  std::set<FrameKey> chosen;
  std::vector<FrameKey> between;
  const auto choose = [&] {
    const std::vector<FrameKey> spread = Spread(between, num_between);
    chosen.insert(spread.begin(), spread.end());
    between.clear();
  };
  auto keyframe = frames_.begin();
  for (const FrameKey& key : others) {
    if (frames_.count(key) > 0) continue;
    for (; keyframe != frames_.end() && keyframe->first < key; ++keyframe) choose();
    between.push_back(key);
  }
  choose();
  return chosen;
}

FrameObservations SequenceRecord::Finalize(const FrameObservations& seen, int segment) const {
  FrameObservations known{seen.frame, segment, seen.keyframe, {}, {}, {}};
  for (Observation observation : seen.observations) {
    observation.landmark = Resolve(observation.landmark);
    if (in_world_.count(observation.landmark) > 0) known.observations.push_back(observation);
  }
  return known;
}

std::vector<Bundle> SequenceRecord::MakeBundles() const {
  std::map<int, Bundle> bundles;
  std::map<int, std::vector<Entry>> entries;
  for (const auto& [key, frame] : frames_) {
    Bundle& bundle = bundles[frame.seen.segment];
    if (bundle.views.empty()) bundle.world_from_local = frame.world_from_camera;
    const int view = static_cast<int>(bundle.views.size());
    bundle.views.push_back({frame.seen.keyframe, false,
                            (bundle.world_from_local.Inverse() * frame.world_from_camera).data()});
    for (const Observation& observation : frame.seen.observations) {
      entries[frame.seen.segment].push_back({observation, view});
    }
  }
  std::vector<Bundle> thinned;
  for (auto& [segment, bundle] : bundles) {
    AddPoints(in_world_, entries[segment], bundle);
    thinned.push_back(ThinPoints(bundle, options_.max_points));
  }
  return thinned;
}

}  // namespace corvo
