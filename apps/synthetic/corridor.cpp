// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/motion.h"
#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {
namespace {

constexpr double kBegin = -4, kEnd = 60;                  ///< Along x, m.
constexpr double kHalfWidth = 1.1, kCeilingHeight = 2.6;  ///< Along y and z, m.
constexpr double kDoorSpacing = 5, kLampSpacing = 4;      ///< m
constexpr double kNoticeSpacing = 9;                      ///< m
constexpr double kReach = 25, kSpeed = 1.2;  ///< Range and speed of the walk, m and m/s.

/// Returns the canvas with its contrast reduced to `percent`, centered on `gray`.
Canvas Faint(Canvas canvas, int gray, int percent) {
  for (std::uint8_t& texel : canvas.texels) {
    texel = static_cast<std::uint8_t>(gray + (texel - 128) * percent / 100);
  }
  return canvas;
}

class CorridorBuilder {
 public:
  std::shared_ptr<const Scene> Build() {
    AddShell();
    AddDoors();
    AddLamps();
    AddNotices();
    return scene_;
  }

 private:
  /// Returns a rectangle on a side wall from `near` to `far` along x. `side` is 1 for the left wall
  /// (y > 0) and -1 for the right one.
  Quad OnSide(int side, double near, double far, double bottom, double top, double gap) const {
    Quad quad;
    quad.right = side * Eigen::Vector3d::UnitX();
    quad.down = -Eigen::Vector3d::UnitZ();
    quad.width = far - near;
    quad.height = top - bottom;
    quad.corner = Eigen::Vector3d(side > 0 ? near : far, side * (kHalfWidth - gap), top);
    return quad;
  }

  /// Returns a rectangle at height z that faces up (`facing` 1, a floor) or down (-1).
  Quad Horizontal(int facing, double z, double near, double far, double half_width) const {
    Quad quad;
    quad.right = Eigen::Vector3d::UnitX();
    quad.down = -facing * Eigen::Vector3d::UnitY();
    quad.width = far - near;
    quad.height = 2 * half_width;
    quad.corner = Eigen::Vector3d(near, facing * half_width, z);
    return quad;
  }

  /// Returns the wall that closes the corridor at its end (`facing` -1) or its beginning (1).
  Quad Across(int facing) const {
    Quad quad;
    quad.right = facing * Eigen::Vector3d::UnitY();
    quad.down = -Eigen::Vector3d::UnitZ();
    quad.width = 2 * kHalfWidth;
    quad.height = kCeilingHeight;
    quad.corner = Eigen::Vector3d(facing > 0 ? kBegin : kEnd, -facing * kHalfWidth, kCeilingHeight);
    return quad;
  }

  void Add(Quad quad, int texture, double texels_per_meter) {
    quad.texture = texture;
    quad.texels_per_meter.setConstant(texels_per_meter);
    quad.texture_origin << 131.0 * static_cast<double>(scene_->quads.size()), 0;
    scene_->AddLit(quad);
  }

  void AddShell() {
    const int wall = scene_->AddTexture(Faint(DrawPlaster(61), 190, 20));
    const int floor = scene_->AddTexture(Faint(DrawAsphalt(62), 110, 15));
    for (const int side : {1, -1}) Add(OnSide(side, kBegin, kEnd, 0, kCeilingHeight, 0), wall, 160);
    for (const int facing : {1, -1}) Add(Across(facing), wall, 160);
    Add(Horizontal(-1, kCeilingHeight, kBegin, kEnd, kHalfWidth), wall, 120);
    Add(Horizontal(1, 0, kBegin, kEnd, kHalfWidth), floor, 200);
  }

  void AddDoors() {
    const int door = scene_->AddTexture(Faint(DrawWood(63), 150, 15));
    int side = 1;
    for (double x = kBegin + 1; x < kEnd - 2; x += kDoorSpacing / 2, side = -side) {
      Add(OnSide(side, x, x + 0.9, 0, 2.05, 0.01), door, 200);
    }
  }

  void AddLamps() {
    const int lamp = scene_->AddTexture(Faint(DrawPlaster(64), 225, 5));
    for (double x = kBegin + 1; x < kEnd - 1; x += kLampSpacing) {
      Add(Horizontal(-1, kCeilingHeight - 0.01, x, x + 1.2, 0.15), lamp, 100);
    }
  }

  void AddNotices() {
    const int notice = scene_->AddTexture(Faint(DrawPoster(65), 170, 60));
    int side = -1;
    for (double x = kBegin + 2.7; x < kEnd - 1; x += kNoticeSpacing, side = -side) {
      Add(OnSide(side, x, x + 0.6, 1.2, 2.0, 0.01), notice, 640);
    }
  }

  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
};

/// Returns the viewpoint of a walk down the corridor and back, facing the same way.
Viewpoint WalkAlong(double seconds) {
  Viewpoint viewpoint;
  const double phase = kSpeed / kReach * seconds + 0.7;
  viewpoint.position =
      Eigen::Vector3d(kReach * (1.0 - std::cos(phase)), 0.15 * std::sin(0.5 * seconds), 1.5);
  viewpoint.yaw = 0.08 * std::sin(0.7 * seconds);
  viewpoint.pitch = -0.05 + 0.04 * std::sin(0.6 * seconds + 1);
  return ShakenByHand(viewpoint, seconds);
}

}  // namespace

Sequence MakeCorridor(const SequenceOptions& options) {
  constexpr double kFrameRateHz = 30;
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 420;
  camera.cx = 319.5;
  camera.cy = 239.5;
  const Camera chosen = ChooseCamera(camera, options);
  std::vector<SE3> poses;
  for (int i = 0; i < options.frames; ++i) {
    poses.push_back(SceneFromCamera(WalkAlong(i / kFrameRateHz)));
  }
  return Sequence("corridor", CorridorBuilder().Build(), chosen, kFrameRateHz, poses, options);
}

}  // namespace corvo::synthetic
