// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "vo/map/observation_callback.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Which frames of a sequence are adjusted as a whole, and how much of each.
struct SequenceOptions {
  /// Frames adjusted with the keyframes, of those between one keyframe and the next; evenly spread.
  int frames_between = 5;
  /// Fewer between keyframes where these and those would be more than so many.
  int max_frames = 1000;
  int max_points = 400;  ///< Seen by an adjusted frame, about: see ThinPoints.
};

/// Segment and index of a frame: the frame before one segment's first may be another's last.
using FrameKey = std::pair<int, int>;

inline FrameKey KeyOf(const FrameObservations& frame) { return {frame.segment, frame.frame}; }

/// A frame to be adjusted: what it saw and where it was.
struct AdjustedFrame {
  FrameObservations seen;
  SE3 world_from_camera;
};

/// What the frames of a finished sequence saw that are to be adjusted as a whole: the keyframes,
/// and some between them. Landmarks have their last names.
class SequenceRecord {
 public:
  /// `log` has recorded the odometry from its first image on.
  SequenceRecord(const Odometry& odometry, const ObservationLog& log,
                 const SequenceOptions& options);

  /// The landmark that it is part of in the end.
  LandmarkId Resolve(LandmarkId id) const;

  const std::map<FrameKey, AdjustedFrame>& frames() const { return frames_; }

  /// One a segment, in their order, its views in the order of its frames.
  std::vector<Bundle> MakeBundles() const;

 private:
  /// Adds what a keyframe saw, or some of it.
  void AddKeyframe(const FrameObservations& seen, const SE3& world_from_camera);
  void KeepLandmarks();
  /// Of the frames that are no keyframes, some between each keyframe and the next.
  std::set<FrameKey> ChooseBetween(const std::set<FrameKey>& others) const;
  /// What a frame saw of the keyframes' landmarks.
  FrameObservations KnownOf(const FrameObservations& seen) const;

  SequenceOptions options_;
  std::map<FrameKey, AdjustedFrame> frames_;
  std::unordered_map<LandmarkId, Eigen::Vector3d> in_world_;  // As the newest keyframe knew it.
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
};

}  // namespace corvo
