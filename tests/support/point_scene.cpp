// SPDX-License-Identifier: MIT
#include "tests/support/point_scene.h"

#include <algorithm>
#include <utility>

namespace corvo::test {

Camera PinholeCamera() {
  CameraParameters parameters;
  parameters.width = 640;
  parameters.height = 480;
  parameters.fx = parameters.fy = 500;
  parameters.cx = 319.5;
  parameters.cy = 239.5;
  return Camera(parameters);
}

MeasurementModel MakeModel(double sigma_px, int num_octaves) {
  return MakeModel(PinholeCamera(), sigma_px, num_octaves);
}

MeasurementModel MakeModel(const Camera& camera, double sigma_px, int num_octaves) {
  MeasurementModel model{camera, {}, {}};
  model.options.keypoint_sigma_px = sigma_px;
  double scale = 1;
  for (int octave = 0; octave < num_octaves; ++octave, scale *= 1.2) {
    model.octave_scales.push_back(scale);
  }
  return model;
}

orb::Descriptor RandomDescriptor(Random& random) {
  orb::Descriptor descriptor;
  for (std::uint8_t& byte : descriptor.bytes) byte = static_cast<std::uint8_t>(random.Bits());
  return descriptor;
}

orb::Descriptor FlipBits(orb::Descriptor descriptor, int num_bits, Random& random) {
  const int first = random.UniformInt(0, 255);
  for (int i = 0; i < num_bits; ++i) {
    const int bit = (first + 7 * i) % 256;
    descriptor.bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
  }
  return descriptor;
}

PointScene MakeBoxScene(int num_points, double min_depth, double max_depth, Random& random) {
  PointScene scene;
  for (int i = 0; i < num_points; ++i) {
    const double depth = random.Uniform(min_depth, max_depth);
    const double x = depth * random.Uniform(-0.8, 0.8);
    scene.in_world.emplace_back(x, depth * random.Uniform(-0.6, 0.6), depth);
    scene.descriptors.push_back(RandomDescriptor(random));
  }
  return scene;
}

PointScene MakePlaneScene(int num_points, double depth, Random& random) {
  PointScene scene;
  for (int i = 0; i < num_points; ++i) {
    const double x = depth * random.Uniform(-0.8, 0.8);
    scene.in_world.emplace_back(x, depth * random.Uniform(-0.6, 0.6), depth + 0.3 * x);
    scene.descriptors.push_back(RandomDescriptor(random));
  }
  return scene;
}

SceneView ObserveScene(const PointScene& scene, const Camera& camera, const SE3& world_from_camera,
                       double sigma_px, Random& random) {
  constexpr int kFlippedBits = 10;
  const int num_points = static_cast<int>(scene.in_world.size());
  const int start = random.UniformInt(0, num_points - 1);
  SceneView view;
  orb::Features features;
  for (int i = 0; i < num_points; ++i) {
    const int point = (start + i) % num_points;
    const auto pixel = camera.Project(world_from_camera.Inverse() * scene.in_world[point]);
    if (!pixel || !camera.Contains(*pixel)) continue;
    orb::Keypoint keypoint;
    keypoint.x = static_cast<float>(pixel->x() + random.Gaussian(sigma_px));
    keypoint.y = static_cast<float>(pixel->y() + random.Gaussian(sigma_px));
    features.keypoints.push_back(keypoint);
    features.descriptors.push_back(FlipBits(scene.descriptors[point], kFlippedBits, random));
    view.points.push_back(point);
  }
  view.frame = MakeFrame(0, 0, std::move(features), camera);
  view.frame.world_from_camera = world_from_camera;
  return view;
}

Map MakeMap(const PointScene& scene, const std::vector<SceneView>& views,
            const MeasurementModel& model) {
  Map map(model);
  std::vector<std::vector<TrackElement>> observations(scene.in_world.size());
  for (const SceneView& view : views) {
    const KeyframeId id = map.AddKeyframe(view.frame, 0);
    for (std::size_t k = 0; k < view.points.size(); ++k) {
      observations[view.points[k]].push_back({id, static_cast<int>(k)});
    }
  }
  for (std::size_t point = 0; point < observations.size(); ++point) {
    if (observations[point].size() < 2) continue;
    const LandmarkId id = map.AddLandmark(scene.in_world[point], observations[point]);
    map.UpdateAppearance(id);
  }
  return map;
}

}  // namespace corvo::test
