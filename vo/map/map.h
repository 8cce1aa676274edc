// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "orb/types.h"
#include "vo/core/conventions.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// Keypoint `keypoint` of keyframe `keyframe` sees a landmark.
struct TrackElement {
  KeyframeId keyframe = kNoId;
  int keypoint = kNoId;

  bool operator==(const TrackElement&) const = default;
};

/// The view in which a landmark is where it is: other views are aligned with it.
struct Reference {
  KeyframeId keyframe = kNoId;
  int octave = 0;
  std::optional<orb::Patch> patch;
  Eigen::Vector2d offset_px =
      Eigen::Vector2d::Zero();  ///< Of the landmark from the patch's middle.
};

/// A 3D point and how it looks.
struct Landmark {
  LandmarkId id = kNoId;
  int segment = 0;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
  std::vector<TrackElement> track;     ///< At most one element for each keyframe, by keyframe.
  KeyframeId newest_keyframe = kNoId;  ///< The newest keyframe when the landmark was made.
  orb::Descriptor descriptor;          ///< The medoid of its observations' descriptors.
  Eigen::Vector3d view_direction = Eigen::Vector3d::Zero();  ///< Mean unit vector, camera to point.
  Reference reference;
  double max_distance = 0;  ///< From the camera, at which it would be detected in octave 0.
  int num_visible = 1;      ///< Frames in which it should have been seen.
  int num_found = 1;        ///< Frames in which it was.
};

/// A frame kept in the map.
struct Keyframe {
  KeyframeId id = kNoId;
  int segment = 0;
  Frame frame;
};

/// What is left of a landmark whose keyframes have left the map. It never moves again.
struct MarginalizedLandmark {
  LandmarkId id = kNoId;
  int segment = 0;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
};

/// A landmark became part of another.
struct LandmarkMerge {
  LandmarkId from = kNoId;
  LandmarkId into = kNoId;

  bool operator==(const LandmarkMerge&) const = default;
};

/// A keyframe and the number of landmarks that it shares with another.
struct Covisible {
  KeyframeId keyframe = kNoId;
  int num_shared = 0;
};

/// The first of them, at most `max_count`.
std::vector<KeyframeId> FirstKeyframes(const std::vector<Covisible>& covisible, int max_count);

/// Owns keyframes and landmarks. Links between them are ids, kept consistent both ways: keypoint k
/// of keyframe f names landmark l if and only if l has the observation (f, k).
///
/// A keyframe leaves when it is retired or archived. Then its features and observations are gone;
/// its id, segment and pose stay.
///
/// All its images are measured by one model, whose camera may be estimated anew.
class Map {
 public:
  explicit Map(MeasurementModel model) : model_(std::move(model)) {}

  const MeasurementModel& model() const { return model_; }
  const Camera& camera() const { return model_.camera; }
  /// Keyframes get their rays by this camera when they are next used: see UpdateRays.
  void SetCamera(const Camera& camera) { model_.camera = camera; }

  bool empty() const { return keyframe_poses_.empty(); }
  int num_keyframes() const {
    return static_cast<int>(keyframe_poses_.size());
  }  ///< Also those that left.
  int num_landmarks() const { return static_cast<int>(landmarks_.size()); }  ///< That live.
  int num_landmark_ids() const { return num_landmark_ids_; }

  /// It has not left.
  bool IsActive(KeyframeId id) const { return keyframes_.count(id) > 0; }
  /// It was retired: its frame is one like any other.
  bool IsCulled(KeyframeId id) const { return keyframe_poses_[id].anchor != kNoId; }
  /// Those that have not left, in ascending order.
  std::vector<KeyframeId> ActiveKeyframes() const;
  /// Of one that is kept.
  const Keyframe& keyframe(KeyframeId id) const { return keyframes_.at(id); }

  /// Segment of any keyframe.
  int SegmentOf(KeyframeId id) const { return keyframe_poses_[id].segment; }
  /// Pose of any keyframe, retired ones through their anchors.
  SE3 WorldFromKeyframe(KeyframeId id) const;

  /// Null if there is none, or it was removed, merged or finished.
  const Landmark* FindLandmark(LandmarkId id) const;
  /// The landmark that `id` was merged into, directly or by stages; `id` itself if it lives;
  /// kNoId if it was removed or finished, or the merge is forgotten.
  LandmarkId Resolve(LandmarkId id) const;

  /// Keeps a frame; its `landmarks` become observations.
  KeyframeId AddKeyframe(Frame frame, int segment);
  /// The keyframe leaves; its pose hangs on `anchor` from now on.
  void CullKeyframe(KeyframeId id, KeyframeId anchor);
  /// Drops the patches around a keyframe's keypoints: nothing more is aligned in it. No effect on
  /// one that is not kept.
  void DropPatches(KeyframeId id);
  /// corvo::UpdateRays of a keyframe that is kept: to be called before its rays are used, since the
  /// camera may have been estimated anew.
  void UpdateRays(KeyframeId id);
  /// The keyframe leaves; its pose stays as it is for ever. Landmarks that lose their second last
  /// observation leave with it and are returned, in the order of its keypoints.
  std::vector<MarginalizedLandmark> MarginalizeKeyframe(KeyframeId id);
  /// Of a keyframe that is kept.
  void SetPose(KeyframeId id, const SE3& world_from_camera);

  /// Two or more observations, each of a keypoint that sees nothing yet.
  LandmarkId AddLandmark(const Eigen::Vector3d& in_world, std::vector<TrackElement> track);
  /// Sets where a keypoint of a keyframe, aligned with its landmark, sees it, and the ray.
  void SetPixel(const TrackElement& observation, const Eigen::Vector2d& pixel,
                const Eigen::Vector2d& ray);
  void SetPosition(LandmarkId id, const Eigen::Vector3d& in_world);
  void RemoveLandmark(LandmarkId id);
  /// Moves the observations of `from` to `into` where `into` has none in that keyframe.
  void MergeLandmark(LandmarkId from, LandmarkId into);
  /// Forgets what was merged before the keyframe was added.
  void ForgetMergesBefore(KeyframeId keyframe);
  /// Counts a frame in which landmarks should be visible, those that still exist, and those that it
  /// observes as found.
  void CountSeen(const std::vector<LandmarkId>& visible, const Frame& frame);

  /// The keypoint must see nothing yet, and the landmark nothing in that keyframe.
  void AddTrackElement(LandmarkId id, const TrackElement& observation);
  /// Removes the landmark too when fewer than two observations are left.
  void RemoveTrackElement(LandmarkId id, KeyframeId keyframe);

  /// Recomputes descriptor, view direction and distance from the observations.
  void UpdateAppearance(LandmarkId id);

  /// Landmarks that an active keyframe observes, in the order of its keypoints.
  std::vector<LandmarkId> LandmarksOf(KeyframeId id) const;
  /// Landmarks that any of the keyframes sees, in id order.
  std::vector<LandmarkId> FindObserved(const std::vector<KeyframeId>& keyframes) const;

  /// Keyframes that share at least `min_shared` landmarks with `id`, most first, then newest first.
  std::vector<Covisible> FindCovisible(KeyframeId id, int min_shared = 1) const;
  /// As FindCovisible for a frame that is not in the map.
  std::vector<Covisible> FindCovisible(const Frame& frame, int min_shared = 1) const;

  /// Memory held by kept keyframes and living landmarks.
  std::size_t working_set_bytes() const;
  /// Memory held by what stays of every keyframe.
  std::size_t keyframe_bytes() const { return keyframe_poses_.size() * sizeof(KeyframePose); }

 private:
  Reference MakeReference(const TrackElement& observation);
  /// What stays of a keyframe.
  struct KeyframePose {
    SE3 pose;                   // anchor_from_keyframe or, without an anchor, world_from_keyframe.
    KeyframeId anchor = kNoId;  // Of a retired keyframe.
    int segment = 0;
  };
  struct Merge {
    KeyframeId newest_keyframe;
    LandmarkId from;
  };

  std::vector<Covisible> CountShared(const std::vector<LandmarkId>& landmarks, KeyframeId except,
                                     int min_shared) const;

  MeasurementModel model_;
  std::unordered_map<KeyframeId, Keyframe> keyframes_;  // Kept.
  std::unordered_map<LandmarkId, Landmark> landmarks_;  // Living.
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
  std::deque<Merge> merges_;                 // What is in merged_into_, in order of time.
  std::deque<KeyframePose> keyframe_poses_;  // Of every keyframe.
  int num_landmark_ids_ = 0;
};

}  // namespace corvo
