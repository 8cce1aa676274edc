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

/// What became of a frame given to the Initializer.
struct InitializationResult {
  Reason reason = Reason::kNone;  ///< kNone: `map` is set.
  std::optional<InitialMap> map;  ///< Between the reference frame and the newest.
  /// Input index of the reference frame, or, where that one is of no use, of the last frame before
  /// whose rotation is known.
  int reference = kNoId;
  /// Set if between the two the camera turned or stood still, as far as the matches tell.
  std::optional<SO3> reference_from_newest;
  int num_matches = 0;
  int num_inliers = 0;
  double parallax_deg = 0;
};

/// Collects frames until the newest and a reference frame make a map.
class Initializer {
 public:
  Initializer(const OdometryOptions& options, const MeasurementModel& model);

  /// Sees by another camera from now on, in the frames that wait too.
  void SetCamera(const Camera& camera);

  /// Takes a frame whose pose is known as the reference. Only where no frame is collected.
  void StartFrom(Frame posed);

  InitializationResult AddFrame(Frame frame);

  /// The frames collected, in order; the newest is the last. Forgets them.
  std::vector<Frame> TakeFrames();
  /// The newest frame collected; null if there is none.
  const Frame* newest() const { return frames_.empty() ? nullptr : &frames_.back(); }
  /// Index of the reference frame within the frames collected.
  int reference() const { return reference_; }
  std::size_t num_bytes() const;  ///< Of the frames collected.

 private:
  /// Forgets the oldest frame when there are too many.
  void Keep(Frame frame);
  /// Half-way to the newest frame: near enough to match again, far enough to keep some parallax.
  /// If there is one, a frame whose rotation is known.
  void MoveReference();
  void MakeMap(const std::vector<orb::Match>& matches, InitializationResult& result);
  /// The twofold ambiguity of a plane is waited out.
  TwoViewResult EstimateMotion(const std::vector<orb::Match>& matches);
  /// Where the reference is of no use, the rotation against the last frame that has one.
  void ContinueRotation(InitializationResult& result) const;
  /// With more matches than without the rotation.
  SO3 RefineRotation(const Frame& reference, const SO3& reference_from_newest) const;
  /// With the newest frame.
  std::vector<RayMatch> ToRayMatches(const Frame& first,
                                     const std::vector<orb::Match>& matches) const;

  InitializerOptions options_;
  FrameMatchingOptions matching_;
  BundleAdjuster adjuster_;
  MeasurementModel model_;
  std::deque<Frame> frames_;
  PlaneHypotheses planes_;
  std::deque<bool> has_rotation_;  // Of each frame, whether its rotation is known.
  int reference_ = 0;
};

}  // namespace corvo
