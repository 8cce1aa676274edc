#include "vo/refiner.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <unordered_map>

#include "vo/pose_optimizer.h"

namespace corvo {
namespace {

/// What is known of the keyframes, under the landmarks' last names.
class SequenceRecord {
 public:
  SequenceRecord(const Odometry& odometry, const SightingsSource& sightings) {
    const auto keep = [this](const FrameSightings& frame) {
      for (const LandmarkMerge& merge : frame.merges) merged_into_[merge.from] = merge.into;
      if (frame.keyframe != kNoId) keyframes_[frame.keyframe] = frame;
    };
    sightings(keep);
    odometry.VisitKeyframes(keep);
    for (auto& [id, keyframe] : keyframes_) {
      for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
        LandmarkId& landmark = keyframe.landmarks[i].landmark;
        landmark = Resolve(landmark);
        in_world_[landmark] = keyframe.in_world[i];
      }
    }
  }

  /// The landmark that it is part of in the end.
  LandmarkId Resolve(LandmarkId id) const {
    for (auto merged = merged_into_.find(id); merged != merged_into_.end();
         merged = merged_into_.find(id)) {
      id = merged->second;
    }
    return id;
  }

  const std::map<KeyframeId, FrameSightings>& keyframes() const { return keyframes_; }
  /// As the newest keyframe that saw it knew it.
  const Eigen::Vector3d& PositionOf(LandmarkId id) const { return in_world_.at(id); }

 private:
  std::map<KeyframeId, FrameSightings> keyframes_;
  std::unordered_map<LandmarkId, Eigen::Vector3d> in_world_;
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
};

/// Adds the points and sightings of a bundle that has its views.
void AddPoints(const SequenceRecord& record, Bundle& bundle) {
  struct Entry {
    int view;
    LandmarkSighting sighting;
  };
  std::vector<Entry> entries;
  for (int view = 0; view < static_cast<int>(bundle.views.size()); ++view) {
    for (const LandmarkSighting& sighting :
         record.keyframes().at(bundle.views[view].keyframe).landmarks) {
      entries.push_back({view, sighting});
    }
  }
  const auto key = [](const Entry& e) { return std::tuple(e.sighting.landmark, e.view); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [view, sighting] = entries[i];
    if (i > 0 && key(entries[i]) == key(entries[i - 1])) continue;  // Of merged landmarks.
    if (bundle.points.empty() || bundle.points.back().landmark != sighting.landmark) {
      bundle.points.push_back(
          {sighting.landmark, local_from_world * record.PositionOf(sighting.landmark)});
    }
    bundle.sightings.push_back({view, static_cast<int>(bundle.points.size()) - 1, kNoId,
                                sighting.pixel.cast<double>(), sighting.sigma_px});
  }
}

/// One a segment.
std::vector<Bundle> MakeBundles(const Map& map, const SequenceRecord& record, int max_points) {
  std::map<int, Bundle> by_segment;
  for (const auto& [id, keyframe] : record.keyframes()) {
    Bundle& bundle = by_segment[keyframe.segment];
    const SE3 world_from_keyframe = map.WorldFromKeyframe(id);
    if (bundle.views.empty()) bundle.world_from_local = world_from_keyframe;
    bundle.views.push_back(
        {id, false, (bundle.world_from_local.Inverse() * world_from_keyframe).data()});
  }
  std::vector<Bundle> bundles;
  for (auto& [segment, bundle] : by_segment) {
    AddPoints(record, bundle);
    bundles.push_back(ThinPoints(bundle, max_points));
  }
  return bundles;
}

/// Where a keyframe was and is.
struct MovedKeyframe {
  SE3 before, after;  // world_from_camera
};

/// What a refinement made of keyframes and landmarks.
class RefinedMap {
 public:
  RefinedMap(const Map& map, const SequenceRecord& record, const std::vector<Bundle>& bundles) {
    for (const Bundle& bundle : bundles) {
      for (const Bundle::View& view : bundle.views) {
        const FrameSightings& keyframe = record.keyframes().at(view.keyframe);
        keyframes_[{keyframe.segment, keyframe.frame}] = {map.WorldFromKeyframe(view.keyframe),
                                                          bundle.world_from_local * view.Pose()};
      }
      AddLandmarks(record, bundle);
    }
  }

  const std::map<LandmarkId, FinishedLandmark>& landmarks() const { return landmarks_; }
  int num_keyframes() const { return static_cast<int>(keyframes_.size()); }

  bool IsKeyframe(int segment, int frame) const { return keyframes_.count({segment, frame}) > 0; }

  /// Moves a pose with the keyframe of its segment that is, or is before, its frame; with the first
  /// one, if there is none before.
  SE3 Move(const FrameResult& frame) const {
    auto next = keyframes_.upper_bound({frame.segment, frame.index});
    if (next != keyframes_.begin() && std::prev(next)->first.first == frame.segment) --next;
    if (next == keyframes_.end() || next->first.first != frame.segment) {
      return *frame.world_from_camera;
    }
    return next->second.after * (next->second.before.Inverse() * *frame.world_from_camera);
  }

 private:
  void AddLandmarks(const SequenceRecord& record, const Bundle& bundle) {
    std::vector<int> num_inliers(bundle.points.size(), 0);
    for (const Bundle::Sighting& sighting : bundle.sightings) {
      num_inliers[sighting.point] += sighting.is_inlier;
    }
    const int segment = record.keyframes().at(bundle.views.front().keyframe).segment;
    for (std::size_t i = 0; i < bundle.points.size(); ++i) {
      if (num_inliers[i] < 2) continue;
      const LandmarkId id = bundle.points[i].landmark;
      landmarks_[id] = {id, segment, bundle.world_from_local * bundle.points[i].in_local};
    }
  }

  std::map<std::pair<int, int>, MovedKeyframe> keyframes_;  // By segment and frame.
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

/// Moves all posed frames with the keyframes, then places those that are none.
void PlaceFrames(const SequenceRecord& record, const RefinedMap& refined, const Camera& camera,
                 int min_inliers, const SightingsSource& sightings, Refinement& refinement) {
  for (FrameResult& frame : refinement.trajectory.frames) {
    if (!frame.world_from_camera) continue;
    refinement.num_moved += !refined.IsKeyframe(frame.segment, frame.index);
    SetPose(refined.Move(frame), frame);
  }
  sightings([&](const FrameSightings& seen) {
    FrameResult& frame = refinement.trajectory.frames[seen.frame];
    if (seen.keyframe != kNoId || refined.IsKeyframe(seen.segment, seen.frame)) return;
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
  const CalibrationOptions& options = odometry.options().calibration;
  CameraPrior prior{odometry.given_camera(), {}};
  const bool is_estimated = options.enabled && IsCalibrated(prior.given.model);
  if (!is_estimated || odometry.contradicts_given_camera()) return prior;
  prior.free = {{"focal", options.focal_sigma}, {"k1", options.k1_sigma}, {"k2", options.k2_sigma}};
  return prior;
}

Refinement Refine(const Odometry& odometry, const SightingsSource& sightings,
                  const RefinerOptions& options, const std::function<void(double)>& progress) {
  const SequenceRecord record(odometry, sightings);
  std::vector<Bundle> bundles = MakeBundles(odometry.map(), record, options.max_points);
  Refinement refinement;
  refinement.trajectory = odometry.GetTrajectory();
  refinement.adjustment = AdjustFully(PriorOf(odometry), odometry.camera().parameters(),
                                      options.adjustment, bundles, progress);
  if (refinement.adjustment.outcome != AdjustmentOutcome::kLowered) return refinement;
  const RefinedMap refined(odometry.map(), record, bundles);
  refinement.num_keyframes = refined.num_keyframes();
  for (const auto& [id, landmark] : refined.landmarks()) refinement.landmarks.push_back(landmark);
  PlaceFrames(record, refined, Camera(refinement.adjustment.camera),
              odometry.options().tracker.min_inliers, sightings, refinement);
  return refinement;
}

}  // namespace corvo
