// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/optimization/landmark_pose.h"

namespace corvo {

/// The outcome of the search for a frame in the map.
struct TrackingResult {
  Reason reason = Reason::kNone;    ///< kNone if the frame's pose and landmarks are set.
  int num_matches = 0;              ///< Keypoints matched with landmarks.
  int num_inliers = 0;              ///< Matches that are inliers of the pose.
  std::vector<LandmarkId> visible;  ///< Landmarks that should be visible from the pose.
  /// Keypoints whose landmarks contradict the pose. See FindContradictions.
  std::vector<int> contradictions;
  double contested_share = 0;  ///< See RemoveContestedKeypoints. Set for keyframes only.

  /// Returns the share of the visible landmarks that are inliers.
  double found_share() const {
    return visible.empty() ? 0 : num_inliers / static_cast<double>(visible.size());
  }
  bool is_tracked() const { return reason == Reason::kNone; }
};

/// Locates frames in a map, given a previous frame and predictions of the pose.
class Tracker {
 public:
  explicit Tracker(const OdometryOptions& options);

  /// Locates `frame`. The landmarks of the previous frame are matched near their projections from
  /// the first of the predicted world_from_camera (near the others and then in wider windows if few
  /// were found or most of them are outliers; finally without a prediction, with a robust
  /// perspective-n-point pose), which yields a first pose. The landmarks of the local keyframes are
  /// then projected and matched, keypoints are aligned with the patches of their landmarks, and the
  /// pose is optimized again. On success the frame has its pose and landmarks.
  TrackingResult Track(const Map& map, const Frame& previous, const std::vector<SE3>& predictions,
                       Frame& frame) const;

 private:
  /// Sets the frame's first pose from the landmarks of the previous frame. Returns the number of
  /// inliers.
  int TrackPrevious(const Map& map, const Frame& previous, const std::vector<SE3>& predictions,
                    Frame& frame) const;
  /// Returns the best location of searches near the predictions and, if these have few matches or
  /// mostly outliers, of wider ones: a wrong prediction finds keypoints that are merely similar.
  LandmarkPose LocateNearPredictions(const Map& map, const Frame& previous,
                                     const std::vector<SE3>& predictions, Frame& frame) const;
  /// Matches the landmarks of the previous frame near the prediction. Returns the number of
  /// matches.
  int MatchPrevious(const Map& map, const Frame& previous, const SE3& predicted, double radius_px,
                    Frame& frame) const;
  /// Matches the landmarks of the previous frame in the whole image and returns their
  /// perspective-n-point pose, or std::nullopt if that fails.
  std::optional<SE3> LocateWithoutPrediction(const Map& map, const Frame& previous,
                                             Frame& frame) const;
  /// Projects the landmarks of the local keyframes and assigns them to matching keypoints that have
  /// none. Returns the landmarks that should be visible.
  std::vector<LandmarkId> MatchLocalLandmarks(const Map& map, Frame& frame) const;

  TrackerOptions options_;
  MatchingOptions matching_;
  PoseOptimizerOptions pose_optimizer_;
};

}  // namespace corvo
