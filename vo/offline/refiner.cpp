#include "vo/offline/refiner.h"

#include <iterator>
#include <map>
#include <optional>

#include "vo/optimization/pose_optimizer.h"

namespace corvo {
namespace {

/// What a refinement made of frames and landmarks.
class RefinedMap {
 public:
  /// `bundles` as the record made them, adjusted. Frames with fewer inliers are
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

  const std::map<LandmarkId, MarginalizedLandmark>& landmarks() const { return landmarks_; }
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

  std::map<FrameKey, Poses> moves_;
  std::map<LandmarkId, MarginalizedLandmark> landmarks_;
};

void SetPose(const SE3& world_from_camera, FrameResult& frame) {
  frame.world_from_camera = world_from_camera;
  frame.world_from_camera_rotation = world_from_camera.rotation();
}

/// Locates a frame among refined landmarks, if enough of them agree.
std::optional<SE3> Locate(const FrameObservations& frame, const SE3& predicted,
                          const SequenceRecord& record, const RefinedMap& refined,
                          const Camera& camera, int min_inliers) {
  std::vector<PointObservation> observations;
  for (const Observation& observation : frame.landmarks) {
    const auto landmark = refined.landmarks().find(record.Resolve(observation.landmark));
    if (landmark == refined.landmarks().end()) continue;
    observations.push_back(
        {landmark->second.in_world, observation.pixel.cast<double>(), observation.sigma_px});
  }
  const PoseEstimate estimate = OptimizePose(predicted, observations, camera);
  if (estimate.num_inliers < min_inliers) return std::nullopt;
  return estimate.world_from_camera;
}

/// Moves all posed frames with the adjusted ones, then places those that are none.
void PlaceFrames(const SequenceRecord& record, const RefinedMap& refined, const Camera& camera,
                 int min_inliers, const ObservationSource& observations, Refinement& refinement) {
  for (FrameResult& frame : refinement.trajectory.frames) {
    if (!frame.world_from_camera) continue;
    refinement.num_moved += !refined.IsAdjusted({frame.segment, frame.index});
    SetPose(refined.Move(frame), frame);
  }
  observations([&](const FrameObservations& seen) {
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
  if (odometry.prior_rejected()) prior.free.clear();
  return prior;
}

Refinement Refine(const Odometry& odometry, const ObservationSource& observations,
                  const RefinerOptions& options, const AdjustmentProgress& progress) {
  const SequenceRecord record(odometry, observations, options.sequence);
  std::vector<Bundle> bundles = record.MakeBundles();
  Refinement refinement;
  refinement.trajectory = odometry.GetTrajectory();
  refinement.adjustment = AdjustFully(PriorOf(odometry), odometry.camera().parameters(),
                                      options.adjustment, bundles, progress);
  if (refinement.adjustment.outcome != AdjustmentOutcome::kImproved) return refinement;
  const int min_inliers = odometry.options().tracker.min_inliers;
  const RefinedMap refined(record, bundles, min_inliers);
  refinement.num_adjusted = refined.num_frames();
  for (const auto& [id, landmark] : refined.landmarks()) refinement.landmarks.push_back(landmark);
  PlaceFrames(record, refined, Camera(refinement.adjustment.camera), min_inliers, observations,
              refinement);
  return refinement;
}

}  // namespace corvo
