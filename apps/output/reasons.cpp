// SPDX-License-Identifier: MIT
#include "apps/output/reasons.h"

namespace corvo {

std::map<Reason, int> CountReasons(const Trajectory& trajectory) {
  std::map<Reason, int> counts;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera) ++counts[frame.reason];
  }
  return counts;
}

std::string_view Advice(Reason reason) {
  switch (reason) {
    case Reason::kNone:
      return "no reason is known";
    case Reason::kReferenceFrame:
      return "initialization begins here: see the other reasons, or the sequence is too short";
    case Reason::kTooFewFeatures:
      return "the images are too dark, blurred or blank";
    case Reason::kTooFewMatches:
      return "consecutive images change too much: motion blur, or a frame rate that is too low";
    case Reason::kLowParallax:
      return "the camera hardly moves: it must move sideways or forwards";
    case Reason::kRotationOnly:
      return "the camera rotates without translating: it must move sideways or forwards";
    case Reason::kPlanar:
      return "the scene is planar: move until something at another depth comes into view";
    case Reason::kAmbiguousMotion:
      return "no camera motion explains the images: check the camera file, or the scene moves";
    case Reason::kBadTriangulation:
      return "points do not triangulate: check the camera file, or move further";
    case Reason::kTooFewInliers:
      return "tracking was lost: motion blur, fast turns, or moving objects";
    case Reason::kStaticOverlay:
      return "much of the image moves with the camera: exclude it with --mask";
    case Reason::kRepeatedImage:
      return "the image repeats the one before";
    case Reason::kScaleUncertain:
      return "the scale may have changed: a large moving object, or repetitive texture";
    case Reason::kUnreadableImage:
      return "the image could not be read: the file is damaged, cut off or of another format";
    case Reason::kWrongSize:
      return "the image does not have the camera's size";
  }
  return "";
}

}  // namespace corvo
