// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "orb/types.h"
#include "vo/core/conventions.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"
#include "vo/map/segment_join.h"

namespace corvo {

/// One element of a track: keypoint `keypoint` of keyframe `keyframe` observes the landmark.
struct TrackElement {
  KeyframeId keyframe = kNoId;
  int keypoint = kNoId;

  bool operator==(const TrackElement&) const = default;
};

/// The view that defines the position of a landmark in images: other views are aligned with it.
struct Reference {
  KeyframeId keyframe = kNoId;
  int octave = 0;
  std::optional<orb::Patch> patch;
  /// The offset of the landmark from the center of the patch.
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();
};

/// A 3-D point and its appearance.
struct Landmark {
  LandmarkId id = kNoId;
  int segment = 0;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
  std::vector<TrackElement> track;     ///< At most one element per keyframe, by keyframe.
  KeyframeId newest_keyframe = kNoId;  ///< Newest keyframe when the landmark was created.
  orb::Descriptor descriptor;          ///< The medoid of its observations' descriptors.
  Eigen::Vector3d view_direction = Eigen::Vector3d::Zero();  ///< Mean unit vector, camera to point.
  Reference reference;
  double max_distance = 0;  ///< Distance at which it would be detected in octave 0.
  int num_visible = 1;      ///< Frames in which it should have been observed.
  int num_found = 1;        ///< Frames in which it was observed.

  bool IsObservedBy(KeyframeId keyframe) const {
    return std::ranges::any_of(
        track, [&](const TrackElement& element) { return element.keyframe == keyframe; });
  }
};

/// An active frame of the map.
struct Keyframe {
  KeyframeId id = kNoId;
  int segment = 0;
  Frame frame;
};

/// The remainder of a landmark whose keyframes were marginalized. Its position is final.
struct MarginalizedLandmark {
  LandmarkId id = kNoId;
  int segment = 0;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
  int num_joins = 0;  ///< Number of joins of segments before it was marginalized; see ApplyJoins().
};

/// The merge of a landmark into another.
struct LandmarkMerge {
  LandmarkId from = kNoId;
  LandmarkId into = kNoId;

  bool operator==(const LandmarkMerge&) const = default;
};

/// A keyframe and the number of landmarks that it shares with another keyframe or frame.
struct Covisible {
  KeyframeId keyframe = kNoId;
  int num_shared = 0;
};

/// Returns the first keyframes of the list, at most `max_count`.
std::vector<KeyframeId> FirstKeyframes(const std::vector<Covisible>& covisible, int max_count);

/// The owner of keyframes and landmarks. Links between them are ids, kept consistent in both
/// directions: keypoint k of keyframe f names landmark l if and only if the track of l contains (f,
/// k).
///
/// A keyframe is active until it is culled or marginalized. Its features and observations are then
/// removed; its id, segment and pose remain.
///
/// All images are measured by one model, whose camera may be re-estimated.
class Map {
 public:
  /// The first landmark gets the id `first_landmark`: a map that replaces another one continues its
  /// ids, so that an id never denotes two landmarks of one sequence.
  explicit Map(MeasurementModel model, LandmarkId first_landmark = 0)
      : model_(std::move(model)),
        first_landmark_id_(first_landmark),
        num_landmark_ids_(first_landmark) {}

  const MeasurementModel& model() const { return model_; }
  const Camera& camera() const { return model_.camera; }
  /// Sets the camera. Keyframes get their rays in this camera when they are next used, see
  /// UpdateRays.
  void SetCamera(const Camera& camera) { model_.camera = camera; }

  bool empty() const { return keyframe_poses_.empty(); }
  /// Returns the number of keyframes ever added, active or not.
  int num_keyframes() const { return static_cast<int>(keyframe_poses_.size()); }
  /// Returns the number of landmarks that exist.
  int num_landmarks() const { return static_cast<int>(landmarks_.size()); }
  /// Returns the id of the first landmark ever added.
  LandmarkId first_landmark_id() const { return first_landmark_id_; }
  /// Returns the id of the next landmark, which is greater than all others.
  int num_landmark_ids() const { return num_landmark_ids_; }
  /// Returns the joins of segments, in order of time.
  const std::vector<SegmentJoin>& joins() const { return joins_; }
  int num_joins() const { return static_cast<int>(joins_.size()); }

  /// Returns whether the keyframe was neither culled nor marginalized.
  bool IsActive(KeyframeId id) const { return keyframes_.count(id) > 0; }
  /// Returns whether the keyframe was culled, so that its frame is an ordinary posed frame.
  bool IsCulled(KeyframeId id) const { return keyframe_poses_[id].anchor != kNoId; }
  /// Returns the active keyframes, in ascending order.
  std::vector<KeyframeId> ActiveKeyframes() const;
  /// Returns an active keyframe.
  const Keyframe& keyframe(KeyframeId id) const { return keyframes_.at(id); }

  /// Returns the segment of any keyframe.
  int SegmentOf(KeyframeId id) const { return keyframe_poses_[id].segment; }
  /// Returns the highest index of the keyframes' segments, or kNoId without keyframes.
  int NewestSegment() const;
  /// Returns whether no keyframe of a segment was marginalized, so that it may still move.
  bool IsMovable(int segment) const;
  /// Moves the keyframes and landmarks of the later segment, which is movable, to the earlier one.
  void JoinSegments(const SegmentJoin& join);
  /// Returns the pose of any keyframe; that of a culled one follows its anchor.
  SE3 WorldFromKeyframe(KeyframeId id) const;

  /// Returns the landmark, or null if there is none or it was removed, merged or marginalized.
  const Landmark* FindLandmark(LandmarkId id) const;
  /// Returns the landmark that `id` was merged into, directly or in several steps; `id` itself if
  /// it exists; kNoId if it was removed or marginalized, or if the merge is forgotten.
  LandmarkId Resolve(LandmarkId id) const;

  /// Adds a frame as a keyframe; its `landmarks` become observations. Returns its id.
  KeyframeId AddKeyframe(Frame frame, int segment);
  /// Culls a keyframe; from then on its pose is expressed relative to `anchor`.
  void CullKeyframe(KeyframeId id, KeyframeId anchor);
  /// Drops the patches around a keyframe's keypoints, so that they can no longer be aligned. Has no
  /// effect on a keyframe that is not active.
  void DropPatches(KeyframeId id);
  /// Calls corvo::UpdateRays for an active keyframe. Must be called before its rays are used, since
  /// the camera may have been re-estimated.
  void UpdateRays(KeyframeId id);
  /// Marginalizes a keyframe; its pose is final. Landmarks that are left with fewer than two
  /// observations are marginalized with it and returned, in the order of its keypoints.
  std::vector<MarginalizedLandmark> MarginalizeKeyframe(KeyframeId id);
  /// Sets the pose of an active keyframe.
  void SetPose(KeyframeId id, const SE3& world_from_camera);

  /// Adds a landmark with two or more observations, each of a keypoint that observes no landmark
  /// yet. The first observation becomes the reference.
  LandmarkId AddLandmark(const Eigen::Vector3d& in_world, std::vector<TrackElement> track);
  /// Sets the pixel and the ray of a keyframe's keypoint after its alignment with its landmark.
  void SetPixel(const TrackElement& observation, const Eigen::Vector2d& pixel,
                const Eigen::Vector2d& ray);
  void SetPosition(LandmarkId id, const Eigen::Vector3d& in_world);
  void RemoveLandmark(LandmarkId id);
  /// Moves the observations of `from` to `into`, except in keyframes in which `into` already has
  /// one.
  void MergeLandmark(LandmarkId from, LandmarkId into);
  /// Forgets the merges made before the keyframe was added.
  void ForgetMergesBefore(KeyframeId keyframe);
  /// Counts a frame for the statistics of landmarks: those of `visible` that still exist as
  /// visible, and those that the frame observes as found.
  void CountSeen(const std::vector<LandmarkId>& visible, const Frame& frame);

  /// Adds an observation. The keypoint must observe no landmark yet, and the landmark must have no
  /// observation in that keyframe.
  void AddTrackElement(LandmarkId id, const TrackElement& observation);
  /// Removes an observation, and the landmark if fewer than two observations are left.
  void RemoveTrackElement(LandmarkId id, KeyframeId keyframe);

  /// Recomputes the descriptor, view direction and maximum distance from the observations.
  void UpdateAppearance(LandmarkId id);

  /// Returns the landmarks that an active keyframe observes, in the order of its keypoints.
  std::vector<LandmarkId> LandmarksOf(KeyframeId id) const;
  /// Returns the landmarks that any of the keyframes observes, in the order of ids.
  std::vector<LandmarkId> FindObserved(const std::vector<KeyframeId>& keyframes) const;

  /// Returns the keyframes that share at least `min_shared` landmarks with `id`, most shared first,
  /// then newest first.
  std::vector<Covisible> FindCovisible(KeyframeId id, int min_shared = 1) const;
  /// Like FindCovisible above, but for a frame that is not in the map.
  std::vector<Covisible> FindCovisible(const Frame& frame, int min_shared = 1) const;

  /// Returns the memory held by active keyframes and existing landmarks, bytes.
  std::size_t working_set_bytes() const;
  /// Returns the memory held by the part of every keyframe that is never removed, bytes.
  std::size_t keyframe_bytes() const { return keyframe_poses_.size() * sizeof(KeyframePose); }

 private:
  Reference MakeReference(const TrackElement& observation);
  /// The part of a keyframe that is never removed.
  struct KeyframePose {
    SE3 pose;                   // anchor_from_keyframe or, without an anchor, world_from_keyframe.
    KeyframeId anchor = kNoId;  // For a culled keyframe.
    int segment = 0;
  };
  struct Merge {
    KeyframeId newest_keyframe;
    LandmarkId from;
  };

  std::vector<Covisible> CountShared(const std::vector<LandmarkId>& landmarks, KeyframeId except,
                                     int min_shared) const;

  MeasurementModel model_;
  std::unordered_map<KeyframeId, Keyframe> keyframes_;  // Active.
  std::unordered_map<LandmarkId, Landmark> landmarks_;  // Existing.
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
  std::deque<Merge> merges_;                 // Entries of merged_into_, in order of time.
  std::deque<KeyframePose> keyframe_poses_;  // Indexed by KeyframeId.
  std::vector<SegmentJoin> joins_;
  LandmarkId first_landmark_id_ = 0;
  int num_landmark_ids_ = 0;
};

/// Returns the depths of the landmarks that a frame observes, in the order of its keypoints.
std::vector<double> DepthsOfLandmarks(const Map& map, const Frame& frame);

}  // namespace corvo
