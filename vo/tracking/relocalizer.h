// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Locates frames without a prediction, after tracking was lost.
class Relocalizer {
 public:
  explicit Relocalizer(const OdometryOptions& options);

  /// Locates `frame` among the keyframes of one segment. Each keypoint votes for the newest
  /// keyframes that observe the landmark most similar to it; the frame is then tracked from the
  /// keyframes with the most votes, one after the other, until a pose has enough inliers. On
  /// success the frame has its pose and landmarks. The rays of the keyframes tried are updated to
  /// the map's camera.
  TrackingResult Relocalize(int segment, Map& map, Frame& frame) const;

 private:
  RelocalizerOptions options_;
  MatchingOptions matching_;
  Tracker tracker_;
};

}  // namespace corvo
