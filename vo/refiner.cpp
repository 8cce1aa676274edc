#include "vo/refiner.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "vo/pose_optimizer.h"

namespace corvo {
namespace {

/// Segment and index of a frame: the frame before one segment's first may be another's last.
using FrameKey = std::pair<int, int>;

FrameKey KeyOf(const FrameSightings& frame) { return {frame.segment, frame.frame}; }

/// A frame to be adjusted: what it saw and where it was.
struct AdjustedFrame {
  FrameSightings seen;
  SE3 world_from_camera;
};

/// At most `max_count` of the elements, evenly spread.
std::vector<FrameKey> Spread(const std::vector<FrameKey>& elements, int max_count) {
  const auto size = static_cast<long>(elements.size());
  if (size <= max_count) return elements;
  std::vector<FrameKey> spread;
  for (long i = 0; i < max_count; ++i) {
    spread.push_back(elements[(2 * i + 1) * size / (2 * max_count)]);
  }
  return spread;
}

/// The frames to be adjusted, which see landmarks under their last names.
class SequenceRecord {
 public:
  SequenceRecord(const Odometry& odometry, const SightingsSource& sightings,
                 const RefinerOptions& options) {
    std::set<FrameKey> others;
    const auto keep = [&](const FrameSightings& seen) {
      for (const LandmarkMerge& merge : seen.merges) merged_into_[merge.from] = merge.into;
      if (seen.keyframe == kNoId) {
        others.insert(KeyOf(seen));
      } else if (!odometry.map().IsRetired(seen.keyframe)) {
        Append(seen, odometry.map().WorldFromKeyframe(seen.keyframe));
      }
    };
    sightings(keep);
    odometry.VisitKeyframes(keep);
    KeepLandmarks();
    const std::set<FrameKey> chosen = ChooseBetween(others, NumBetween(options));
    const Trajectory trajectory = odometry.GetTrajectory();
    sightings([&](const FrameSightings& seen) {
      if (seen.keyframe != kNoId || chosen.count(KeyOf(seen)) == 0) return;
      frames_[KeyOf(seen)] = {KnownOf(seen), *trajectory.frames[seen.frame].world_from_camera};
    });
  }

  /// The landmark that it is part of in the end.
  LandmarkId Resolve(LandmarkId id) const {
    for (auto merged = merged_into_.find(id); merged != merged_into_.end();
         merged = merged_into_.find(id)) {
      id = merged->second;
    }
    return id;
  }

  const std::map<FrameKey, AdjustedFrame>& frames() const { return frames_; }
  /// As the newest keyframe that saw it knew it.
  const Eigen::Vector3d& PositionOf(LandmarkId id) const { return in_world_.at(id); }

 private:
  /// What a keyframe saw, or some of it.
  void Append(const FrameSightings& seen, const SE3& world_from_camera) {
    AdjustedFrame& frame = frames_[KeyOf(seen)];
    frame.world_from_camera = world_from_camera;
    FrameSightings& all = frame.seen;
    all.frame = seen.frame;
    all.segment = seen.segment;
    all.keyframe = seen.keyframe;
    all.landmarks.insert(all.landmarks.end(), seen.landmarks.begin(), seen.landmarks.end());
    all.in_world.insert(all.in_world.end(), seen.in_world.begin(), seen.in_world.end());
  }

  void KeepLandmarks() {
    for (auto& [key, frame] : frames_) {
      for (std::size_t i = 0; i < frame.seen.landmarks.size(); ++i) {
        LandmarkId& landmark = frame.seen.landmarks[i].landmark;
        landmark = Resolve(landmark);
        in_world_[landmark] = frame.seen.in_world[i];
      }
    }
  }

  int NumBetween(const RefinerOptions& options) const {
    const int num_keyframes = std::max(1, static_cast<int>(frames_.size()));
    return std::clamp(options.max_frames / num_keyframes - 1, 0, options.frames_between);
  }

  /// Of the frames that are no keyframes, some between each keyframe and the next.
  std::set<FrameKey> ChooseBetween(const std::set<FrameKey>& others, int frames_between) const {
    std::set<FrameKey> chosen;
    std::vector<FrameKey> between;
    const auto choose = [&] {
      const std::vector<FrameKey> spread = Spread(between, frames_between);
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

  /// What a frame saw of the keyframes' landmarks.
  FrameSightings KnownOf(const FrameSightings& seen) const {
    FrameSightings known{seen.frame, seen.segment, seen.keyframe, {}, {}, {}};
    for (LandmarkSighting sighting : seen.landmarks) {
      sighting.landmark = Resolve(sighting.landmark);
      if (in_world_.count(sighting.landmark) > 0) known.landmarks.push_back(sighting);
    }
    return known;
  }

  std::map<FrameKey, AdjustedFrame> frames_;
  std::unordered_map<LandmarkId, Eigen::Vector3d> in_world_;
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
};

/// What a view of a bundle saw.
struct Entry {
  LandmarkSighting sighting;
  int view;
};

/// Adds the points and sightings of a bundle that has its views.
void AddPoints(const SequenceRecord& record, std::vector<Entry> entries, Bundle& bundle) {
  const auto key = [](const Entry& e) { return std::pair(e.sighting.landmark, e.view); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [sighting, view] = entries[i];
    if (i > 0 && key(entries[i]) == key(entries[i - 1])) continue;  // Of merged landmarks.
    if (bundle.points.empty() || bundle.points.back().landmark != sighting.landmark) {
      bundle.points.push_back(
          {sighting.landmark, local_from_world * record.PositionOf(sighting.landmark)});
    }
    bundle.sightings.push_back({view, static_cast<int>(bundle.points.size()) - 1, kNoId,
                                sighting.pixel.cast<double>(), sighting.sigma_px});
  }
}

/// One a segment, its views in the order of its frames.
std::map<int, Bundle> MakeBundles(const SequenceRecord& record) {
  std::map<int, Bundle> bundles;
  std::map<int, std::vector<Entry>> entries;
  for (const auto& [key, frame] : record.frames()) {
    Bundle& bundle = bundles[frame.seen.segment];
    if (bundle.views.empty()) bundle.world_from_local = frame.world_from_camera;
    const int view = static_cast<int>(bundle.views.size());
    bundle.views.push_back({frame.seen.keyframe, false,
                            (bundle.world_from_local.Inverse() * frame.world_from_camera).data()});
    for (const LandmarkSighting& sighting : frame.seen.landmarks) {
      entries[frame.seen.segment].push_back({sighting, view});
    }
  }
  for (auto& [segment, bundle] : bundles) AddPoints(record, entries[segment], bundle);
  return bundles;
}

/// What a refinement made of frames and landmarks.
class RefinedMap {
 public:
  /// `bundles` as MakeBundles made them, one a segment, adjusted. Frames with fewer inliers are
  /// left out.
  RefinedMap(const SequenceRecord& record, const std::vector<Bundle>& bundles, int min_inliers) {
    auto frame = record.frames().begin();
    for (const Bundle& bundle : bundles) {
      AddLandmarks(bundle, frame->second.seen.segment);
      const std::vector<int> num_inliers = CountInliers(bundle);
      for (std::size_t view = 0; view < bundle.views.size(); ++view, ++frame) {
        if (num_inliers[view] < min_inliers) continue;
        moves_[frame->first] = {frame->second.world_from_camera,
                                bundle.world_from_local * bundle.views[view].Pose()};
      }
    }
  }

  const std::map<LandmarkId, FinishedLandmark>& landmarks() const { return landmarks_; }
  int num_frames() const { return static_cast<int>(moves_.size()); }
  bool IsAdjusted(const FrameKey& frame) const { return moves_.count(frame) > 0; }

  /// Moves a posed frame with the adjusted frame of its segment that it is, or that is before it;
  /// with the first one, if none is before.
  SE3 Move(const FrameResult& frame) const {
    auto next = moves_.upper_bound({frame.segment, frame.index});
    if (next != moves_.begin() && std::prev(next)->first.first == frame.segment) --next;
    if (next == moves_.end() || next->first.first != frame.segment) return *frame.world_from_camera;
    return next->second.after * (next->second.before.Inverse() * *frame.world_from_camera);
  }

 private:
  struct Poses {
    SE3 before, after;  // world_from_camera
  };

  /// Of each view.
  static std::vector<int> CountInliers(const Bundle& bundle) {
    std::vector<int> num_inliers(bundle.views.size(), 0);
    for (const Bundle::Sighting& sighting : bundle.sightings) {
      num_inliers[sighting.view] += sighting.is_inlier;
    }
    return num_inliers;
  }

  void AddLandmarks(const Bundle& bundle, int segment) {
    std::vector<int> num_inliers(bundle.points.size(), 0);
    for (const Bundle::Sighting& sighting : bundle.sightings) {
      num_inliers[sighting.point] += sighting.is_inlier;
    }
    for (std::size_t i = 0; i < bundle.points.size(); ++i) {
      if (num_inliers[i] < 2) continue;
      const LandmarkId id = bundle.points[i].landmark;
      landmarks_[id] = {id, segment, bundle.world_from_local * bundle.points[i].in_local};
    }
  }

  std::map<FrameKey, Poses> moves_;
  std::map<LandmarkId, FinishedLandmark> landmarks_;
};

void SetPose(const SE3& world_from_camera, FrameResult& frame) {
  frame.world_from_camera = world_from_camera;
  frame.world_from_camera_rotation = world_from_camera.rotation();
}

/// Locates a frame among refined landmarks, if enough of them agree.
std::optional<SE3> Locate(const FrameSightings& sightings, const SE3& predicted,
                          const SequenceRecord& record, const RefinedMap& refined,
                          const Camera& camera, int min_inliers) {
  std::vector<PointObservation> observations;
  for (const LandmarkSighting& sighting : sightings.landmarks) {
    const auto landmark = refined.landmarks().find(record.Resolve(sighting.landmark));
    if (landmark == refined.landmarks().end()) continue;
    observations.push_back(
        {landmark->second.in_world, sighting.pixel.cast<double>(), sighting.sigma_px});
  }
  const PoseEstimate estimate = OptimizePose(predicted, observations, camera);
  if (estimate.num_inliers < min_inliers) return std::nullopt;
  return estimate.world_from_camera;
}

/// Moves all posed frames with the adjusted ones, then places those that are none.
void PlaceFrames(const SequenceRecord& record, const RefinedMap& refined, const Camera& camera,
                 int min_inliers, const SightingsSource& sightings, Refinement& refinement) {
  for (FrameResult& frame : refinement.trajectory.frames) {
    if (!frame.world_from_camera) continue;
    refinement.num_moved += !refined.IsAdjusted({frame.segment, frame.index});
    SetPose(refined.Move(frame), frame);
  }
  sightings([&](const FrameSightings& seen) {
    FrameResult& frame = refinement.trajectory.frames[seen.frame];
    if (seen.keyframe != kNoId || refined.IsAdjusted(KeyOf(seen))) return;
    const auto located =
        Locate(seen, *frame.world_from_camera, record, refined, camera, min_inliers);
    if (!located) return;
    SetPose(*located, frame);
    ++refinement.num_placed;
    --refinement.num_moved;
  });
}

}  // namespace

CameraPrior PriorOf(const Odometry& odometry) {
  CameraPrior prior = odometry.camera_prior();
  if (odometry.contradicts_given_camera()) prior.free.clear();
  return prior;
}

Refinement Refine(const Odometry& odometry, const SightingsSource& sightings,
                  const RefinerOptions& options, const AdjustmentProgress& progress) {
  const SequenceRecord record(odometry, sightings, options);
  std::vector<Bundle> bundles;
  for (const auto& [segment, bundle] : MakeBundles(record)) {
    bundles.push_back(ThinPoints(bundle, options.max_points));
  }
  Refinement refinement;
  refinement.trajectory = odometry.GetTrajectory();
  refinement.adjustment = AdjustFully(PriorOf(odometry), odometry.camera().parameters(),
                                      options.adjustment, bundles, progress);
  if (refinement.adjustment.outcome != AdjustmentOutcome::kLowered) return refinement;
  const int min_inliers = odometry.options().tracker.min_inliers;
  const RefinedMap refined(record, bundles, min_inliers);
  refinement.num_adjusted = refined.num_frames();
  for (const auto& [id, landmark] : refined.landmarks()) refinement.landmarks.push_back(landmark);
  PlaceFrames(record, refined, Camera(refinement.adjustment.camera), min_inliers, sightings,
              refinement);
  return refinement;
}

}  // namespace corvo
