// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <vector>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/motion.h"
#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {
namespace {

/// Returns a scene with the plane x = 0, which is visible from negative x.
std::shared_ptr<const Scene> BuildWall() {
  auto scene = std::make_shared<Scene>();
  Quad wall;
  wall.corner = Eigen::Vector3d(0, 10, 10);
  wall.right = -Eigen::Vector3d::UnitY();
  wall.down = -Eigen::Vector3d::UnitZ();
  wall.width = wall.height = 20;
  wall.texture = scene->AddTexture(DrawMural(31));
  wall.texels_per_meter.setConstant(250);
  scene->quads.push_back(wall);
  return scene;
}

Viewpoint SwayAt(double seconds) {
  Viewpoint viewpoint;
  viewpoint.position =
      Eigen::Vector3d(-2.6 + 0.5 * std::sin(0.5 * seconds), 1.6 * std::sin(0.6 * seconds),
                      0.6 * std::sin(0.9 * seconds));
  viewpoint.yaw = 0.15 * std::sin(0.7 * seconds + 0.5);
  viewpoint.pitch = 0.1 * std::sin(0.8 * seconds + 1);
  viewpoint.roll = 0.1 * std::sin(0.5 * seconds);
  return ShakenByHand(viewpoint, seconds);
}

}  // namespace

Sequence MakePlanarWall(const SequenceOptions& options) {
  constexpr double kFrameRateHz = 30;
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 319.5;
  camera.cy = 239.5;
  const Camera chosen = ChooseCamera(camera, options);
  std::vector<SE3> poses;
  for (int i = 0; i < options.frames; ++i)
    poses.push_back(SceneFromCamera(SwayAt(i / kFrameRateHz)));
  return Sequence("wall", BuildWall(), chosen, kFrameRateHz, poses, options);
}

}  // namespace corvo::synthetic
