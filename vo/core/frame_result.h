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
  kInitializing,  ///< The segment has no map yet.
  kTracking,      ///< The frame was located in the map.
  /// Not located, but with a known rotation: since the last frame whose rotation is known, the
  /// camera only turned or stood still.
  kRotationOnly,
  kLost,  ///< Not located. Ends with a relocalized frame or a new segment.
};

/// The reason why a frame is not posed or its pose needs care, or kNone.
enum class Reason : std::uint8_t {
  kNone,              ///< Posed, and no other reason applies.
  kReferenceFrame,    ///< Initializing: this frame is the new reference.
  kTooFewFeatures,    ///< Too few keypoints: dark, blurred or blank.
  kTooFewMatches,     ///< Too few keypoints match the reference or the map.
  kLowParallax,       ///< Initializing: the camera stood still or has not moved enough yet.
  kRotationOnly,      ///< Initializing: the camera turned but did not move.
  kPlanar,            ///< Initializing: a homography explains the matches; the motion is ambiguous.
  kAmbiguousMotion,   ///< Initializing: no motion explains the matches clearly better than others.
  kBadTriangulation,  ///< Initializing: too few points in front with parallax and a low error.
  kTooFewInliers,     ///< Tracking: too few inliers of a pose, or no more than chance gives.
  /// What moves with the camera covers most of the image and leaves too few keypoints; or the pose
  /// depended on it, was discarded when it was found, and could not be computed again.
  kStaticOverlay,
  kRepeatedImage,  ///< Posed: the image repeats that of an earlier frame, whose pose it has.
  /// Posed, but the scale may have changed here: the images do not explain the change of the speed,
  /// or much of what is matched contradicts the pose. See ScaleMonitor.
  kScaleUncertain,
  kUnreadableImage,  ///< The image could not be read. Tracking goes on with the next one.
  kWrongSize,        ///< The image does not have the camera's size and was not used.
};

/// Returns whether the reason says that a frame has no usable image: kUnreadableImage, kWrongSize.
constexpr bool IsMissingImage(Reason reason) {
  return reason == Reason::kUnreadableImage || reason == Reason::kWrongSize;
}

std::string_view ToString(State state);
std::string_view ToString(Reason reason);

/// How well the images determine the pose of a frame. All are 0 for frames without a pose.
struct PoseHealth {
  /// Share of the landmarks that should be visible from the pose that are inliers; 0 if the frame
  /// was located afterwards.
  double found_share = 0;
  /// Share of the cells of a grid of 8 x 6 over the image that hold an inlier. Inliers in one
  /// corner determine a pose badly.
  double image_coverage = 0;
  /// Median standard deviation of the distances of the inliers' landmarks, relative to the
  /// distances. It is small where the keyframes see them with much parallax.
  double distance_sigma = 0;
  /// Standard deviation, relative to the reference keyframe, of the worst determined combination of
  /// translation in units of the landmarks' median distance and rotation in rad: the square root of
  /// the largest eigenvalue of that covariance.
  double weakest_sigma = 0;
  /// Standard deviation of the position after the alignment of the whole segment, in its unit; see
  /// ExpectedDrift(). 0 until the sequence is finished.
  double drift_sigma = 0;
};

/// The outcome of one input frame, except for its pose.
struct FrameOutcome {
  int index = 0;  ///< Index of the input frame, from 0.
  TimeNs time_ns = 0;
  State state = State::kInitializing;
  Reason reason = Reason::kNone;
  bool is_keyframe = false;
  int segment = kNoId;  ///< Only poses of one segment are comparable. kNoId before the first.
  int repeats = kNoId;  ///< Index of the frame whose image this one repeats; or kNoId.
  int num_features = 0;
  /// The finest octave with keypoints; kNoId without keypoints. It is 0 in sharp images, higher in
  /// blurred or enlarged ones, whose finest octaves show nothing that coarser ones do not.
  int finest_octave = kNoId;
  /// Share of the image that was excluded because it moves with the camera, 0 to 1.
  double masked_share = 0;
  int num_matches = 0;  ///< Matches with the reference frame or, with a map, with landmarks.
  int num_inliers = 0;  ///< Matches that are consistent with the motion or pose.
  PoseHealth health;
  double parallax_deg = 0;  ///< Median over the matches, rotation removed; while initializing.
  /// The status of the window adjustment whose result was used before this frame was tracked.
  AdjustmentStatus window_adjustment = AdjustmentStatus::kNone;
  /// The status of the camera estimate whose result was used before this frame was tracked.
  AdjustmentStatus camera_adjustment = AdjustmentStatus::kNone;
};

/// The pose of a frame relative to another frame of its segment, with its covariance.
struct RelativePose {
  int reference = kNoId;  ///< Index of the other frame, which is a keyframe.
  SE3 reference_from_camera;
  /// Covariance of the error ξ = [υ ω] of the pose, which is reference_from_camera * Exp(ξ): υ in
  /// units of the segment, ω in rad.
  SE3::Matrix6 covariance = SE3::Matrix6::Zero();
};

/// Returns the covariance of [υ ω] in a unit of length that is 1 / `scale` of the former one.
SE3::Matrix6 ScaleCovariance(double scale, SE3::Matrix6 covariance);

/// The outcome and pose of one input frame. A value type.
struct FrameResult : FrameOutcome {
  /// Set if and only if the frame is posed: located from enough inlier landmarks, either while
  /// tracking or afterwards by pose optimization. A frame that `repeats` another one has the pose
  /// of that frame. Never predicted or interpolated.
  std::optional<SE3> world_from_camera;
  /// Set if the frame is posed: its pose relative to its reference keyframe, which is the newest
  /// one when the frame was located. That of a keyframe is the one before it; that of the first
  /// one of a segment is the second. Missing if the reference is no longer a posed frame of the
  /// same segment.
  std::optional<RelativePose> relative_pose;
  /// Set if the frame is posed or in State::kRotationOnly. Rotations of two segments share one
  /// reference frame only if the rotation was tracked without a gap between them.
  std::optional<SO3> world_from_camera_rotation;
};

}  // namespace corvo
