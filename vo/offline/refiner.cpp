// SPDX-License-Identifier: MIT
#include "vo/offline/refiner.h"

#include <iterator>
#include <map>
#include <optional>

#include "vo/optimization/pose_optimizer.h"

namespace corvo {
namespace {

/// The refined poses of frames and positions of landmarks.
class RefinedMap {
 public:
  /// `bundles` are the adjusted bundles of the record. Frames with fewer inliers are left out.
  RefinedMap(const SequenceRecord& record, const std::vector<Bundle>& bundles, int min_inliers)
      : record_(record) {
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

  const std::map<LandmarkId, MarginalizedLandmark>& landmarks() const { return landmarks_; }
  /// Returns null if the landmark, or the one that it was merged into, was not refined.
  const MarginalizedLandmark* FindLandmark(LandmarkId id) const {
    const auto found = landmarks_.find(record_.Resolve(id));
    return found == landmarks_.end() ? nullptr : &found->second;
  }
  int num_frames() const { return static_cast<int>(moves_.size()); }
  bool IsAdjusted(const FrameKey& frame) const { return moves_.count(frame) > 0; }

  /// Returns the pose of a posed frame, moved with the adjusted frame of its segment that it is or
  /// that precedes it, or with the first one if none precedes it.
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

  /// Returns the number of inliers in each view.
  static std::vector<int> CountInliers(const Bundle& bundle) {
    std::vector<int> num_inliers(bundle.views.size(), 0);
    for (const Bundle::Observation& observation : bundle.observations) {
      num_inliers[observation.view] += observation.is_inlier;
    }
    return num_inliers;
  }

  void AddLandmarks(const Bundle& bundle, int segment) {
    std::vector<int> num_inliers(bundle.points.size(), 0);
    for (const Bundle::Observation& observation : bundle.observations) {
      num_inliers[observation.point] += observation.is_inlier;
    }
    for (std::size_t i = 0; i < bundle.points.size(); ++i) {
      if (num_inliers[i] < 2) continue;
      const LandmarkId id = bundle.points[i].landmark;
      landmarks_[id] = {id, segment, bundle.world_from_local * bundle.points[i].in_local};
    }
  }

  const SequenceRecord& record_;
  std::map<FrameKey, Poses> moves_;
  std::map<LandmarkId, MarginalizedLandmark> landmarks_;
};

void SetPose(const SE3& world_from_camera, FrameResult& frame) {
  frame.world_from_camera = world_from_camera;
  frame.world_from_camera_rotation = world_from_camera.rotation();
}

/// Locates a frame among refined landmarks. Returns std::nullopt if it has too few inliers.
std::optional<SE3> Locate(const FrameObservations& frame, const SE3& predicted,
                          const RefinedMap& refined, const Camera& camera, int min_inliers) {
  PoseObservations observations;
  for (const Observation& observation : frame.observations) {
    const MarginalizedLandmark* landmark = refined.FindLandmark(observation.landmark);
    if (landmark != nullptr) observations.Add({landmark->in_world}, observation);
  }
  const PoseEstimate estimate = OptimizePose(predicted, observations, camera);
  if (estimate.num_inliers < min_inliers) return std::nullopt;
  return estimate.world_from_camera;
}

/// Moves all posed frames with the adjusted ones.
void MoveFrames(const RefinedMap& refined, Refinement& refinement) {
  for (FrameResult& frame : refinement.trajectory.frames) {
    if (!frame.world_from_camera || frame.repeats != kNoId) continue;
    refinement.num_moved += !refined.IsAdjusted({frame.segment, frame.index});
    SetPose(refined.Move(frame), frame);
  }
}

/// Locates the posed frames that were not adjusted among the refined landmarks.
void LocateFrames(const RefinedMap& refined, int min_inliers, const ObservationLog& log,
                  Refinement& refinement) {
  const Camera camera(refinement.adjustment.camera);
  log.Visit([&](const FrameObservations& seen) {
    FrameResult& frame = refinement.trajectory.frames[seen.frame];
    // The odometry may have discarded the pose of the frame and started anew.
    if (!frame.world_from_camera) return;
    if (seen.keyframe != kNoId || refined.IsAdjusted({frame.segment, frame.index})) return;
    const auto located = Locate(seen, *frame.world_from_camera, refined, camera, min_inliers);
    if (!located) return;
    SetPose(*located, frame);
    ++refinement.num_placed;
    --refinement.num_moved;
  });
}

/// Gives frames that repeat the image of another one the pose of that one.
void CopyRepeats(std::vector<FrameResult>& frames) {
  for (FrameResult& frame : frames) {
    if (frame.repeats == kNoId) continue;
    frame.world_from_camera = frames[frame.repeats].world_from_camera;
    frame.world_from_camera_rotation = frames[frame.repeats].world_from_camera_rotation;
  }
}

}  // namespace

CameraPrior PriorOf(const Odometry& odometry) {
  CameraPrior prior = odometry.camera_prior();
  if (odometry.prior_rejected()) prior.free.clear();
  return prior;
}

Refinement Refine(const Odometry& odometry, const ObservationLog& log,
                  const RefinerOptions& options, const AdjustmentProgress& progress) {
  const SequenceRecord record(odometry, log, options.sequence);
  std::vector<Bundle> bundles = record.MakeBundles();
  Refinement refinement;
  refinement.trajectory = odometry.GetTrajectory();
  refinement.adjustment =
      BundleAdjuster(options.adjustment)
          .Adjust(PriorOf(odometry), odometry.camera().parameters(), bundles, progress);
  if (!refinement.adjustment.is_usable()) return refinement;
  const int min_inliers = odometry.options().tracker.min_inliers;
  const RefinedMap refined(record, bundles, min_inliers);
  refinement.num_adjusted = refined.num_frames();
  for (const auto& [id, landmark] : refined.landmarks()) refinement.landmarks.push_back(landmark);
  MoveFrames(refined, refinement);
  LocateFrames(refined, min_inliers, log, refinement);
  CopyRepeats(refinement.trajectory.frames);
  UpdateRelativePoses(refinement.trajectory);
  return refinement;
}

}  // namespace corvo
