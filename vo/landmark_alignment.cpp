#include "vo/landmark_alignment.h"

#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "orb/patch_alignment.h"

namespace corvo {
namespace {

/// How a step in the frame, around a landmark's pixel, becomes one in the landmark's reference,
/// both in pixels of the input image.
std::optional<Eigen::Matrix2d> ReferenceFromFrame(const Map& map, const Landmark& landmark,
                                                  const SE3& world_from_frame,
                                                  const Camera& camera) {
  const SE3 reference_from_world = map.WorldFromKeyframe(landmark.reference.keyframe).Inverse();
  const SE3 frame_from_world = world_from_frame.Inverse();
  const SO3 frame_from_reference =
      frame_from_world.rotation() * reference_from_world.rotation().Inverse();
  Camera::Jacobian reference_by_point, frame_by_point;
  if (!camera.Project(reference_from_world * landmark.in_world, &reference_by_point) ||
      !camera.Project(frame_from_world * landmark.in_world, &frame_by_point)) {
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

std::optional<AlignedKeypoint> Align(const Map& map, const Landmark& landmark, const Camera& camera,
                                     const std::vector<double>& octave_scales, const Frame& frame,
                                     int k) {
  constexpr float kMinCorrelation = 0.8F;
  if (!landmark.reference.patch || frame.patches.empty()) return std::nullopt;
  const double scale = octave_scales[frame.keypoint(k).octave];
  const auto reference_from_frame =
      ReferenceFromFrame(map, landmark, frame.world_from_camera, camera);
  if (!reference_from_frame) return std::nullopt;
  const orb::PatchWarp warp =
      ToWarp(scale / octave_scales[landmark.reference.octave] * *reference_from_frame);
  const auto alignment = orb::AlignPatch(*landmark.reference.patch, frame.patches[k], warp);
  if (!alignment || alignment->correlation < kMinCorrelation) return std::nullopt;
  const Eigen::Vector2d pixel = frame.detected_pixel(k) +
                                scale * Eigen::Vector2d(alignment->x, alignment->y) +
                                reference_from_frame->inverse() * landmark.reference.offset_px;
  const auto ray = camera.Undistort(pixel);
  if (!ray) return std::nullopt;
  return AlignedKeypoint{pixel, *ray};
}

}  // namespace

bool AlignKeypoint(const Map& map, const Landmark& landmark, const Camera& camera,
                   const std::vector<double>& octave_scales, Frame& frame, int k) {
  const auto aligned = Align(map, landmark, camera, octave_scales, frame, k);
  if (!aligned) return false;
  frame.pixels[k] = aligned->pixel;
  frame.rays[k] = aligned->ray;
  frame.is_aligned[k] = 1;
  return true;
}

bool AlignObservation(LandmarkId id, const Observation& observation, const Camera& camera,
                      const std::vector<double>& octave_scales, Map& map) {
  const Landmark& landmark = *map.FindLandmark(id);
  if (observation.keyframe == landmark.reference.keyframe) return false;
  const auto aligned = Align(map, landmark, camera, octave_scales,
                             map.keyframe(observation.keyframe).frame, observation.keypoint);
  if (!aligned) return false;
  map.SetPixel(observation, aligned->pixel, aligned->ray);
  return true;
}

void AlignKeypoints(const Map& map, const Camera& camera, const std::vector<double>& octave_scales,
                    Frame& frame) {
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
    if (landmark != nullptr) AlignKeypoint(map, *landmark, camera, octave_scales, frame, k);
  }
}

}  // namespace corvo
