// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// What a posed frame says about the scale of its segment.
struct ScaleEvidence {
  double inlier_share = 1;  ///< Share of the matches with landmarks that are inliers of the pose.
  double contested_share = 0;  ///< Share of the keypoints that are likely on a moving object.
  double duration_s = 0;       ///< Time since the previous posed frame.
  double speed = 0;            ///< Distance from the previous posed frame over that time, units/s.
  double depth = 0;            ///< Median depth of the landmarks that the frame observes, units.
};

ScaleEvidence CollectScaleEvidence(const Map& map, const Frame& previous, const Frame& frame,
                                   const TrackingResult& tracking);

/// Returns the 80% quantile, over the cells of a grid, of the median angles by which matches
/// between two posed frames moved, less what the rotation of the camera explains, rad. Returns
/// std::nullopt if too few cells have matches.
std::optional<double> MeasureParallaxFlow(const Frame& previous, const Frame& frame);

/// Finds posed frames whose scale cannot be relied upon. A monocular map has no scale of its own:
/// wrong landmarks, such as those on a large moving object or on a repetitive texture, change it
/// without leaving a trace in the residuals. Three signs are used:
///
/// - For several frames, about as many matches with landmarks contradict the pose as agree with it.
/// - Much of the frame is contested, see RemoveContestedKeypoints.
/// - The speed has changed by a large factor within a few frames, and the flow of the images has
///   not: at the depth of the scene before the change, speed v causes a flow of v / depth.
///
/// An object that covers about half of the image or more can hide the flow of the scene, and then
/// leaves none of these signs.
class ScaleMonitor {
 public:
  /// Takes the posed frames of one segment in order. Returns whether the scale of this one is
  /// uncertain. `measure_flow` is MeasureParallaxFlow of the frame; it is called only after a
  /// change of the speed.
  bool Add(const ScaleEvidence& evidence,
           const std::function<std::optional<double>()>& measure_flow);

 private:
  /// Returns whether the share of inliers was low in the newest frames.
  bool HasFewInliers() const;
  /// Returns the median depth before a change of the speed, or std::nullopt if there is no change.
  std::optional<double> DepthBeforeChange() const;

  std::deque<ScaleEvidence> recent_;  // Oldest first.
};

}  // namespace corvo
