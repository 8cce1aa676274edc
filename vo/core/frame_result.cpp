// SPDX-License-Identifier: MIT
#include "vo/core/frame_result.h"

namespace corvo {

std::string_view ToString(State state) {
  switch (state) {
    case State::kInitializing:
      return "initializing";
    case State::kTracking:
      return "tracking";
    case State::kRotationOnly:
      return "rotation_only";
    case State::kLost:
      return "lost";
  }
  return "unknown";
}

std::string_view ToString(Reason reason) {
  switch (reason) {
    case Reason::kNone:
      return "none";
    case Reason::kReferenceFrame:
      return "reference_frame";
    case Reason::kTooFewFeatures:
      return "too_few_features";
    case Reason::kTooFewMatches:
      return "too_few_matches";
    case Reason::kLowParallax:
      return "low_parallax";
    case Reason::kRotationOnly:
      return "rotation_only";
    case Reason::kPlanar:
      return "planar";
    case Reason::kAmbiguousMotion:
      return "ambiguous_motion";
    case Reason::kBadTriangulation:
      return "bad_triangulation";
    case Reason::kTooFewInliers:
      return "too_few_inliers";
    case Reason::kStaticOverlay:
      return "static_overlay";
    case Reason::kRepeatedImage:
      return "repeated_image";
    case Reason::kScaleUncertain:
      return "scale_uncertain";
    case Reason::kUnreadableImage:
      return "unreadable_image";
    case Reason::kWrongSize:
      return "wrong_size";
  }
  return "unknown";
}

SE3::Matrix6 ScaleCovariance(double scale, SE3::Matrix6 covariance) {
  covariance.topRows<3>() *= scale;
  covariance.leftCols<3>() *= scale;
  return covariance;
}

}  // namespace corvo
