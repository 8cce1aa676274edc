// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"

namespace corvo {

/// What became of a frame that was searched for in the map.
struct TrackingResult {
  Reason reason = Reason::kNone;    ///< kNone: the frame's pose and landmarks are set.
  int num_matches = 0;              ///< Keypoints matched with landmarks.
  int num_inliers = 0;              ///< Of num_matches, those that agree with the pose.
  std::vector<LandmarkId> visible;  ///< Landmarks that should be visible from the pose.

  bool is_tracked() const { return reason == Reason::kNone; }
};

/// Locates frames in a map, given where a previous frame was and roughly where the next one is.
class Tracker {
 public:
  explicit Tracker(const OdometryOptions& options);

  /// Locates `frame`. Landmarks of the previous frame are matched near where the predicted
  /// world_from_camera puts them (in wider windows where few were found or most of them disagree
  /// with one pose; at last anywhere, with a robust perspective-n-point pose), which gives a first
  /// pose. The landmarks of the local keyframes are then projected and matched, keypoints are
  /// aligned with the patches of their landmarks, and the pose is optimized again. On success the
  /// frame has its pose and landmarks.
  TrackingResult Track(const Map& map, const Frame& previous, const SE3& predicted,
                       Frame& frame) const;

 private:
  /// A pose and what the keypoints of a frame observe from there.
  struct Location {
    SE3 world_from_camera;
    std::vector<LandmarkId> landmarks;
    int num_inliers = 0;
  };

  /// Sets the frame's first pose, by the landmarks of the previous frame. Returns the inliers.
  int TrackPrevious(const Map& map, const Frame& previous, const SE3& predicted,
                    Frame& frame) const;
  /// The better location of a search near the prediction and, where most of its matches disagree
  /// with one pose, of a wider one: a wrong prediction finds keypoints that are merely similar.
  Location LocateNearPrediction(const Map& map, const Frame& previous, const SE3& predicted,
                                Frame& frame) const;
  /// Matches the landmarks of the previous frame near the prediction. Returns the matches.
  int MatchPrevious(const Map& map, const Frame& previous, const SE3& predicted, double radius_px,
                    Frame& frame) const;
  /// Matches the landmarks of the previous frame anywhere, without a prediction.
  std::optional<SE3> LocateWithoutPrediction(const Map& map, const Frame& previous,
                                             Frame& frame) const;
  /// Projects the landmarks of the local keyframes and assigns those that match free keypoints.
  /// Returns the landmarks that should be visible.
  std::vector<LandmarkId> MatchLocalLandmarks(const Map& map, Frame& frame) const;
  /// Optimizes the pose over the frame's landmarks; those that disagree are taken from the frame.
  /// Returns the inliers.
  int OptimizePose(const Map& map, const SE3& initial, Frame& frame) const;

  TrackerOptions options_;
  MatchingOptions matching_;
  PoseOptimizerOptions pose_optimizer_;
};

}  // namespace corvo
