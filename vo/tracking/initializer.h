// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "orb/matcher.h"
#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/geometry/planar_motion.h"
#include "vo/geometry/two_view.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/initial_map.h"
#include "vo/map/measurement_model.h"
#include "vo/optimization/bundle_adjuster.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {

/// The outcome of a frame given to the Initializer.
struct InitializationResult {
  Reason reason = Reason::kNone;  ///< kNone if `map` is set.
  std::optional<InitialMap> map;  ///< Map of the reference frame and the newest one.
  /// Input index of the reference frame or, if that one is unusable, of the last earlier frame
  /// whose rotation is known.
  int reference = kNoId;
  /// Set if, as far as the matches tell, the camera only rotated or stood still between the two
  /// frames.
  std::optional<SO3> reference_from_newest;
  int num_matches = 0;
  int num_inliers = 0;
  double parallax_deg = 0;
};

/// Collects frames until the newest one and a reference frame yield an initial map.
class Initializer {
 public:
  Initializer(const OdometryOptions& options, const MeasurementModel& model);

  /// Replaces the camera, also for the frames collected so far.
  void SetCamera(const Camera& camera);

  /// Removes the keypoints of the collected frames at which `mask` is zero.
  void RemoveMasked(const cv::Mat& mask);

  /// Adds a posed frame as the reference. Must be called only while no frame is collected.
  void StartFrom(Frame posed);

  InitializationResult AddFrame(Frame frame);

  /// Returns the collected frames in order, the newest last, and clears the collection.
  std::vector<Frame> TakeFrames();
  /// Returns the newest collected frame, or null if there is none.
  const Frame* newest() const { return frames_.empty() ? nullptr : &frames_.back(); }
  /// Returns the index of the reference frame among the collected frames.
  int reference() const { return reference_; }
  std::size_t num_bytes() const;  ///< Memory held by the collected frames.

 private:
  /// Adds a frame to the collection and drops the oldest one if there are too many.
  void Keep(Frame frame);
  /// Moves the reference halfway to the newest frame: near enough to be matched again, far enough
  /// to keep some parallax. Prefers frames whose rotation is known.
  void MoveReference();
  void MakeMap(const std::vector<orb::Match>& matches, InitializationResult& result);
  /// Estimates the motion between the reference and the newest frame. If a plane leaves its motion
  /// ambiguous, the result is Reason::kPlanar until later frames resolve the ambiguity.
  TwoViewResult EstimateMotion(const std::vector<orb::Match>& matches);
  /// Estimates the rotation relative to the last frame whose rotation is known, for a reference
  /// that yields neither a map nor a rotation.
  void ContinueRotation(InitializationResult& result) const;
  /// Refines a rotation with guided matches, which are more than those found without it.
  SO3 RefineRotation(const Frame& reference, const SO3& reference_from_newest) const;
  /// Converts matches with the newest frame to rays.
  std::vector<RayMatch> ToRayMatches(const Frame& first,
                                     const std::vector<orb::Match>& matches) const;

  InitializerOptions options_;
  FrameMatchingOptions matching_;
  BundleAdjuster adjuster_;
  MeasurementModel model_;
  std::deque<Frame> frames_;
  PlaneHypotheses planes_;
  std::deque<bool> has_rotation_;  // True for frames whose rotation is known.
  int reference_ = 0;
};

}  // namespace corvo
