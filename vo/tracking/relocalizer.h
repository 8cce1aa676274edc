// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Locates frames without a prediction, after tracking was lost.
class Relocalizer {
 public:
  explicit Relocalizer(const OdometryOptions& options);

  /// Locates `frame` among the keyframes of a segment or, failing that, among those of all others.
  /// Each keypoint votes for the newest keyframes that observe the landmark most similar to it; the
  /// frame is then tracked from the keyframes with the most votes, one after the other, until a
  /// pose has enough inliers. On success the frame has its pose and landmarks. The rays of the
  /// keyframes tried are updated to the map's camera.
  TrackingResult Relocalize(int segment, Map& map, Frame& frame) const;

  /// Like Relocalize(), but only among the keyframes of all other segments.
  TrackingResult RelocalizeElsewhere(int segment, Map& map, Frame& frame) const;

 private:
  /// Locates `frame` among the newest of `keyframes`, which are ascending.
  TrackingResult RelocalizeAmong(std::vector<KeyframeId> keyframes, Map& map, Frame& frame) const;

  RelocalizerOptions options_;
  MatchingOptions matching_;
  Tracker tracker_;
};

/// Returns the segment of the landmarks of a located frame.
int SegmentOf(const Map& map, const Frame& frame);

}  // namespace corvo
