// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "vo/core/adjustment_status.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"

namespace corvo {

enum class State : std::uint8_t {
  kInitializing,  ///< No map in this segment yet.
  kTracking,      ///< The frame was located in the map.
  kRotationOnly,  ///< Not located, but its rotation is known: against the last frame whose rotation
                  ///< is known the camera only turned, or stood still.
  kLost,          ///< Not located; until a frame is found again or a new segment starts.
};

/// Why a frame is not posed (or what happened to one that is).
enum class Reason : std::uint8_t {
  kNone,              ///< Posed.
  kReferenceFrame,    ///< Initializing: this frame is the new reference.
  kTooFewFeatures,    ///< Too few keypoints: dark, blurred or blank.
  kTooFewMatches,     ///< Too few keypoints match the reference or the map.
  kLowParallax,       ///< Initializing: standing still, or not moved enough yet.
  kRotationOnly,      ///< Initializing: the camera turned but did not move.
  kPlanar,            ///< Initializing: a homography explains the matches; motion is ambiguous.
  kAmbiguousMotion,   ///< Initializing: no motion explains the matches clearly best.
  kBadTriangulation,  ///< Initializing: too few points lie in front, with parallax and low error.
  kTooFewInliers,     ///< Tracking: too few landmarks agree with a pose.
  kRepeatedImage,     ///< Posed: the image repeats that of an earlier frame, whose pose it has.
};

std::string_view ToString(State state);
std::string_view ToString(Reason reason);

/// What happened to one input frame, but for where the camera was.
struct FrameOutcome {
  int index = 0;  ///< Of the input frame, from 0.
  TimeNs time_ns = 0;
  State state = State::kInitializing;
  Reason reason = Reason::kNone;
  bool is_keyframe = false;
  int segment = kNoId;  ///< Poses compare only within one segment. kNoId before the first.
  int repeats = kNoId;  ///< Index of the frame whose image this one repeats; or kNoId.
  int num_features = 0;
  int num_matches = 0;  ///< With the reference frame (initializing) or with landmarks (tracking).
  int num_inliers = 0;  ///< Of num_matches, those that agree with the motion or pose.
  double parallax_deg = 0;  ///< While initializing: median over the matches, rotation removed.
  /// How the adjustment of a window ended whose result was used before this frame was tracked.
  AdjustmentStatus window_adjustment = AdjustmentStatus::kNone;
  /// The same of an estimate of the camera.
  AdjustmentStatus camera_adjustment = AdjustmentStatus::kNone;
};

/// What happened to one input frame. A value.
struct FrameResult : FrameOutcome {
  /// Set if and only if the frame is posed: located from enough inlier landmarks, while tracking
  /// or afterwards by pose optimization. Never held, predicted or interpolated.
  std::optional<SE3> world_from_camera;
  /// Set if the frame is posed, and in State::kRotationOnly. Keeps its meaning from one segment to
  /// the next only where it was tracked all the way.
  std::optional<SO3> world_from_camera_rotation;
};

}  // namespace corvo
