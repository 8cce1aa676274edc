// SPDX-License-Identifier: MIT
#include "apps/output/map_ply.h"

#include <fmt/format.h>

namespace corvo {
namespace {

constexpr const char* kLandmarkColor = "160 160 160";
constexpr const char* kKeyframeColor = "220 30 30";

std::string Vertex(const Eigen::Vector3d& in_world, const char* color, int segment) {
  return fmt::format("{:.9g} {:.9g} {:.9g} {} {}\n", in_world.x(), in_world.y(), in_world.z(),
                     color, segment);
}

std::string Header(int num_vertices) {
  return fmt::format(
      "ply\nformat ascii 1.0\ncomment corvo map: landmarks gray, keyframes red\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int segment\n"
      "end_header\n",
      num_vertices);
}

}  // namespace

std::string MapPly(const LandmarkSpool& finished, const Map& map, double meters_per_unit) {
  std::string vertices;
  finished.ForEach([&](const MarginalizedLandmark& landmark) {
    vertices += Vertex(meters_per_unit * landmark.in_world, kLandmarkColor, landmark.segment);
  });
  for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    vertices += Vertex(meters_per_unit * landmark->in_world, kLandmarkColor, landmark->segment);
  }
  for (KeyframeId id = 0; id < map.num_keyframes(); ++id) {
    vertices += Vertex(meters_per_unit * map.WorldFromKeyframe(id).translation(), kKeyframeColor,
                       map.SegmentOf(id));
  }
  return Header(finished.size() + map.num_landmarks() + map.num_keyframes()) + vertices;
}

std::string MapPly(const Refinement& refinement, double meters_per_unit) {
  std::string vertices;
  int num_vertices = static_cast<int>(refinement.landmarks.size());
  for (const MarginalizedLandmark& landmark : refinement.landmarks) {
    vertices += Vertex(meters_per_unit * landmark.in_world, kLandmarkColor, landmark.segment);
  }
  for (const FrameResult& frame : refinement.trajectory.frames) {
    if (!frame.is_keyframe || !frame.world_from_camera) continue;
    vertices += Vertex(meters_per_unit * frame.world_from_camera->translation(), kKeyframeColor,
                       frame.segment);
    ++num_vertices;
  }
  return Header(num_vertices) + vertices;
}

}  // namespace corvo
