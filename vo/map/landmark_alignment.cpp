// SPDX-License-Identifier: MIT
#include "vo/map/landmark_alignment.h"

#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "orb/patch_alignment.h"

namespace corvo {
namespace {

/// Returns the derivative of a point's pixel in a reference with respect to its pixel in a frame,
/// both in pixels of the input image, on the plane through the point that is parallel to the image
/// of the reference.
std::optional<Eigen::Matrix2d> ReferenceFromFrame(const Eigen::Vector3d& in_reference,
                                                  const Eigen::Vector3d& in_frame,
                                                  const SO3& frame_from_reference,
                                                  const Camera& camera) {
  Camera::Jacobian reference_by_point, frame_by_point;
  if (!camera.Project(in_reference, &reference_by_point) ||
      !camera.Project(in_frame, &frame_by_point)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d frame_by_plane =
      (frame_by_point * frame_from_reference.matrix()).leftCols<2>();
  if (std::abs(frame_by_plane.determinant()) < 1e-12) return std::nullopt;
  return reference_by_point.leftCols<2>() * frame_by_plane.inverse();
}

orb::PatchWarp ToWarp(const Eigen::Matrix2d& matrix) {
  const Eigen::Matrix2f m = matrix.cast<float>();
  return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
}

struct AlignedKeypoint {
  Eigen::Vector2d pixel;
  Eigen::Vector2d ray;
};

/// Returns the position at which keypoint `k` of a frame shows what the patch of a reference shows
/// at its offset.
std::optional<AlignedKeypoint> AlignWithReference(const Reference& reference,
                                                  const Eigen::Matrix2d& reference_from_frame,
                                                  const MeasurementModel& model, const Frame& frame,
                                                  int k) {
  const double scale = model.Scale(frame, k);
  const orb::PatchWarp warp =
      ToWarp(scale / model.octave_scales[reference.octave] * reference_from_frame);
  const auto alignment = orb::AlignPatch(*reference.patch, frame.patches[k], warp);
  if (!alignment || alignment->correlation < model.options.min_correlation) return std::nullopt;
  const Eigen::Vector2d pixel = frame.detected_pixel(k) +
                                scale * Eigen::Vector2d(alignment->x, alignment->y) +
                                reference_from_frame.inverse() * reference.offset_px;
  const auto ray = model.camera.Undistort(pixel);
  if (!ray) return std::nullopt;
  return AlignedKeypoint{pixel, *ray};
}

std::optional<AlignedKeypoint> Align(const Map& map, const Landmark& landmark, const Frame& frame,
                                     int k) {
  const Reference& reference = landmark.reference;
  if (!reference.patch || frame.patches.empty()) return std::nullopt;
  const SE3 reference_from_world = map.WorldFromKeyframe(reference.keyframe).Inverse();
  const SE3 frame_from_world = frame.world_from_camera.Inverse();
  const auto reference_from_frame = ReferenceFromFrame(
      reference_from_world * landmark.in_world, frame_from_world * landmark.in_world,
      frame_from_world.rotation() * reference_from_world.rotation().Inverse(), map.camera());
  if (!reference_from_frame) return std::nullopt;
  return AlignWithReference(reference, *reference_from_frame, map.model(), frame, k);
}

}  // namespace

bool AlignKeypoint(const Map& map, const Landmark& landmark, Frame& frame, int k) {
  const auto aligned = Align(map, landmark, frame, k);
  if (!aligned) return false;
  frame.pixels[k] = aligned->pixel;
  frame.rays[k] = aligned->ray;
  frame.is_aligned[k] = 1;
  return true;
}

bool AlignTrackElement(LandmarkId id, const TrackElement& observation, Map& map) {
  const Landmark& landmark = *map.FindLandmark(id);
  if (observation.keyframe == landmark.reference.keyframe) return false;
  const auto aligned =
      Align(map, landmark, map.keyframe(observation.keyframe).frame, observation.keypoint);
  if (!aligned) return false;
  map.SetPixel(observation, aligned->pixel, aligned->ray);
  return true;
}

std::optional<Eigen::Vector2d> AlignRotatedMatch(const Frame& first, const Frame& second,
                                                 const orb::Match& match,
                                                 const SO3& second_from_first,
                                                 const MeasurementModel& model) {
  if (first.patches.empty() || second.patches.empty()) return std::nullopt;
  const Eigen::Vector3d in_first = first.rays[match.query].homogeneous();
  const auto first_from_second =
      ReferenceFromFrame(in_first, second_from_first * in_first, second_from_first, model.camera);
  if (!first_from_second) return std::nullopt;
  const Reference reference{kNoId, first.keypoint(match.query).octave, first.patches[match.query],
                            first.pixel(match.query) - first.detected_pixel(match.query)};
  const auto aligned =
      AlignWithReference(reference, *first_from_second, model, second, match.train);
  if (!aligned) return std::nullopt;
  return aligned->ray;
}

void AlignKeypoints(const Map& map, Frame& frame) {
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
    if (landmark != nullptr) AlignKeypoint(map, *landmark, frame, k);
  }
}

}  // namespace corvo
