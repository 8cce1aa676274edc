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

/// The frames of a sequence that are adjusted as a whole, and the number of their points.
struct SequenceOptions {
  /// Number of frames between one keyframe and the next that are adjusted, too; evenly spread.
  int frames_between = 5;
  /// Fewer frames between keyframes are adjusted if keyframes and these would exceed this number.
  int max_frames = 1000;
  int max_points = 400;  ///< Approximate number per adjusted frame, see ThinPoints().
};

/// Segment and index of a frame. One frame may be the last of a segment and the first of another.
/// The segment is the final one: those that were reported may have been joined with others since.
using FrameKey = std::pair<int, int>;

/// A frame to be adjusted, with its observations and pose.
struct AdjustedFrame {
  FrameObservations seen;  ///< With the final segment.
  SE3 world_from_camera;
};

/// The observations of those frames of a finished sequence that are adjusted as a whole: the
/// keyframes and some frames between them. Merged landmarks have their final ids.
class SequenceRecord {
 public:
  /// Throws corvo::Error if an option is out of range, or if `log` did not record this odometry
  /// from its first image on, see CheckLog().
  SequenceRecord(const Odometry& odometry, const ObservationLog& log,
                 const SequenceOptions& options);

  /// Returns the landmark into which `id` was finally merged, or `id` if it was not merged.
  LandmarkId Resolve(LandmarkId id) const;

  const std::map<FrameKey, AdjustedFrame>& frames() const { return frames_; }

  /// Returns a frame's observations, in its final segment, of landmarks that keyframes observe,
  /// with their final ids.
  FrameObservations Finalize(const FrameObservations& seen, int segment) const;

  /// Returns one bundle for each segment, in ascending order, with views in the order of the
  /// frames.
  std::vector<Bundle> MakeBundles() const;

 private:
  /// Adds all or some of the observations of a keyframe.
  void AddKeyframe(const FrameObservations& seen, const Map& map, const Trajectory& trajectory);
  void KeepLandmarks();
  /// Returns some of the frames between each keyframe and the next; `others` are not keyframes.
  std::set<FrameKey> ChooseBetween(const std::set<FrameKey>& others) const;

  SequenceOptions options_;
  std::map<FrameKey, AdjustedFrame> frames_;
  std::unordered_map<LandmarkId, Eigen::Vector3d> in_world_;  // Positions from the newest keyframe.
  std::unordered_map<LandmarkId, LandmarkId> merged_into_;
};

}  // namespace corvo
