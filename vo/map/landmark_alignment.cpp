#include "vo/map/landmark_alignment.h"

#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "orb/patch_alignment.h"

namespace corvo {
namespace {

/// How a step around a point's pixel in a frame becomes one in a reference, both in pixels of the
/// input image: by the plane through the point that is parallel to the reference's picture.
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

/// Where keypoint `k` of a frame shows what lies `offset_px` from the middle of a patch.
std::optional<AlignedKeypoint> AlignWithPatch(const orb::Patch& patch, int patch_octave,
                                              const Eigen::Vector2d& offset_px,
                                              const Eigen::Matrix2d& reference_from_frame,
                                              const Camera& camera,
                                              const std::vector<double>& octave_scales,
                                              const Frame& frame, int k) {
  constexpr float kMinCorrelation = 0.8F;
  const double scale = octave_scales[frame.keypoint(k).octave];
  const orb::PatchWarp warp = ToWarp(scale / octave_scales[patch_octave] * reference_from_frame);
  const auto alignment = orb::AlignPatch(patch, frame.patches[k], warp);
  if (!alignment || alignment->correlation < kMinCorrelation) return std::nullopt;
  const Eigen::Vector2d pixel = frame.detected_pixel(k) +
                                scale * Eigen::Vector2d(alignment->x, alignment->y) +
                                reference_from_frame.inverse() * offset_px;
  const auto ray = camera.Undistort(pixel);
  if (!ray) return std::nullopt;
  return AlignedKeypoint{pixel, *ray};
}

std::optional<AlignedKeypoint> Align(const Map& map, const Landmark& landmark, const Camera& camera,
                                     const std::vector<double>& octave_scales, const Frame& frame,
                                     int k) {
  const Reference& reference = landmark.reference;
  if (!reference.patch || frame.patches.empty()) return std::nullopt;
  const SE3 reference_from_world = map.WorldFromKeyframe(reference.keyframe).Inverse();
  const SE3 frame_from_world = frame.world_from_camera.Inverse();
  const auto reference_from_frame = ReferenceFromFrame(
      reference_from_world * landmark.in_world, frame_from_world * landmark.in_world,
      frame_from_world.rotation() * reference_from_world.rotation().Inverse(), camera);
  if (!reference_from_frame) return std::nullopt;
  return AlignWithPatch(*reference.patch, reference.octave, reference.offset_px,
                        *reference_from_frame, camera, octave_scales, frame, k);
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

std::optional<Eigen::Vector2d> AlignRotatedMatch(const Frame& first, const Frame& second,
                                                 const orb::Match& match,
                                                 const SO3& second_from_first, const Camera& camera,
                                                 const std::vector<double>& octave_scales) {
  if (first.patches.empty() || second.patches.empty()) return std::nullopt;
  const Eigen::Vector3d in_first = first.rays[match.query].homogeneous();
  const auto first_from_second =
      ReferenceFromFrame(in_first, second_from_first * in_first, second_from_first, camera);
  if (!first_from_second) return std::nullopt;
  const auto aligned =
      AlignWithPatch(first.patches[match.query], first.keypoint(match.query).octave,
                     first.pixel(match.query) - first.detected_pixel(match.query),
                     *first_from_second, camera, octave_scales, second, match.train);
  if (!aligned) return std::nullopt;
  return aligned->ray;
}

void AlignKeypoints(const Map& map, const Camera& camera, const std::vector<double>& octave_scales,
                    Frame& frame) {
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
    if (landmark != nullptr) AlignKeypoint(map, *landmark, camera, octave_scales, frame, k);
  }
}

}  // namespace corvo
