// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/motion.h"
#include "apps/synthetic/random.h"
#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {
namespace {

constexpr double kLength = 6, kWidth = 5, kHeight = 3;  ///< Along x, y, z; the floor's center is 0.
constexpr double kLoopSeconds = 10;

CameraParameters RoomCamera() {
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

class RoomBuilder {
 public:
  std::shared_ptr<const Scene> Build() {
    AddShell();
    AddFurniture();
    AddPosters();
    return scene_;
  }

 private:
  Material NewMaterial(Canvas canvas, double texels_per_meter) {
    return {scene_->AddTexture(std::move(canvas)), texels_per_meter};
  }

  /// Returns a rectangle on the wall in direction `yaw` from the middle of the room: offset by
  /// `along` to the right, `bottom` above the floor, and `gap` in front of the wall.
  Quad OnWall(double yaw, double along, double bottom, double width, double height,
              double gap) const {
    const Eigen::Vector3d outwards(std::cos(yaw), std::sin(yaw), 0);
    const double distance = std::abs(outwards.x()) > 0.5 ? kLength / 2 : kWidth / 2;
    Quad quad;
    quad.right = Eigen::Vector3d(outwards.y(), -outwards.x(), 0);
    quad.down = -Eigen::Vector3d::UnitZ();
    quad.width = width;
    quad.height = height;
    quad.corner = (distance - gap) * outwards + along * quad.right;
    quad.corner.z() = bottom + height;
    return quad;
  }

  void AddShell() {
    const Material walls[] = {NewMaterial(DrawPlaster(11), 230), NewMaterial(DrawBricks(12), 250)};
    for (int i = 0; i < 4; ++i) {
      const double width = i % 2 == 0 ? kWidth : kLength;
      Quad wall = OnWall(i * std::numbers::pi / 2, -width / 2, 0, width, kHeight, 0);
      const Material& material = walls[i == 1 ? 1 : 0];
      wall.texture = material.texture;
      wall.texels_per_meter.setConstant(material.texels_per_meter);
      wall.texture_origin << 310.0 * i, 170.0 * i;
      scene_->AddLit(wall);
    }
    AddHorizontal(0, 1, NewMaterial(DrawTiles(13), 300));
    AddHorizontal(kHeight, -1, walls[0]);
  }

  /// Adds a floor (`facing` 1) or a ceiling (-1).
  void AddHorizontal(double z, int facing, const Material& material) {
    Quad quad;
    quad.right = Eigen::Vector3d::UnitX();
    quad.down = -facing * Eigen::Vector3d::UnitY();
    quad.width = kLength;
    quad.height = kWidth;
    quad.corner = Eigen::Vector3d(-kLength / 2, facing * kWidth / 2, z);
    quad.texture = material.texture;
    quad.texels_per_meter.setConstant(material.texels_per_meter);
    scene_->AddLit(quad);
  }

  void AddFurniture() {
    const Material wood = NewMaterial(DrawWood(14), 300), books = NewMaterial(DrawBooks(15), 330);
    const Material panel = NewMaterial(DrawPanel(16), 260), box = NewMaterial(DrawPoster(17), 500);
    const auto add = [&](double x, double y, double z, double yaw, const Eigen::Vector3d& size,
                         const Material& sides, const Material& top) {
      const Eigen::Vector2d origin(97.0 * scene_->quads.size(), 0);
      scene_->AddBox({{x, y, z}, yaw, size, sides, top, origin, 1.0});
    };
    add(2.8, 1.2, 0, 0, {0.4, 1.8, 2.1}, books, wood);        // Bookcase.
    add(2.5, -1.2, 0, 0, {0.8, 1.6, 0.75}, wood, wood);       // Desk,
    add(2.6, -1.5, 0.75, 0.3, {0.3, 0.5, 0.42}, panel, box);  // with a monitor
    add(2.4, -0.8, 0.75, 0.8, {0.3, 0.25, 0.2}, box, box);    // and parcels on it.
    add(2.7, -0.75, 0.75, -0.2, {0.2, 0.2, 0.34}, books, box);
    add(0.8, 2.2, 0, 0, {1.6, 0.5, 0.9}, panel, wood);  // Sideboard,
    add(0.5, 2.25, 0.9, 0.1, {0.4, 0.3, 0.35}, box, wood);
    add(1.2, 2.2, 0.9, -0.4, {0.3, 0.25, 0.5}, books, box);
    add(-1.6, 2.2, 0, 0, {0.9, 0.6, 1.8}, panel, panel);  // cupboard,
    add(1.0, -2.2, 0, 0, {1.8, 0.5, 0.5}, wood, books);   // bench,
    add(1.5, 0.2, 0, 0.5, {0.7, 0.7, 0.45}, wood, box);   // low table
    add(1.5, 0.25, 0.45, 0.9, {0.25, 0.2, 0.16}, books, box);
    add(-2.7, 0, 0, 0, {0.5, 2.0, 1.0}, books, wood);  // and a shelf behind.
  }

  void AddPosters() {
    const Canvas images[] = {DrawPoster(21), DrawPoster(22), DrawPoster(23), DrawPoster(24)};
    int textures[4];
    for (int i = 0; i < 4; ++i) textures[i] = scene_->AddTexture(images[i]);
    const auto hang = [&](int wall, double along, double bottom, double width, double height,
                          int image) {
      Quad quad = OnWall(wall * std::numbers::pi / 2, along, bottom, width, height, 0.01);
      quad.texture = textures[image];
      quad.texels_per_meter << 512 / width, 512 / height;
      scene_->AddLit(quad);
    };
    hang(0, 0.2, 1.4, 1.0, 1.3, 0);
    hang(0, 1.5, 1.5, 0.7, 0.9, 1);
    hang(0, -0.25, 1.9, 0.35, 0.45, 2);
    hang(1, -0.6, 1.5, 0.9, 1.2, 3);
    hang(1, 1.2, 1.6, 1.2, 0.8, 1);
    hang(2, -1.0, 1.3, 1.1, 1.4, 2);
    hang(3, -2.0, 1.2, 1.2, 0.9, 0);
    hang(3, -0.3, 1.0, 0.8, 1.1, 2);
    hang(3, 1.4, 1.3, 0.9, 0.6, 3);
  }

  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
};

/// Returns the viewpoint on a loop in space. The viewing direction sweeps over the far half of the
/// room.
Viewpoint WalkAt(double seconds) {
  const double phase = 2 * std::numbers::pi * seconds / kLoopSeconds;
  Viewpoint viewpoint;
  viewpoint.position = Eigen::Vector3d(-0.9 + 1.1 * std::cos(phase), 1.35 * std::sin(phase),
                                       1.4 + 0.25 * std::sin(2 * phase + 0.6));
  viewpoint.yaw = 0.45 * std::sin(phase + 2.2) + 0.15 * std::sin(2 * phase);
  viewpoint.pitch = -0.12 + 0.1 * std::sin(phase + 0.4);
  viewpoint.roll = 0.05 * std::sin(3 * phase);
  return ShakenByHand(viewpoint, seconds);
}

Viewpoint TurnAt(double seconds) {
  Viewpoint viewpoint;
  viewpoint.position = Eigen::Vector3d(-0.8, -0.2, 1.4);
  viewpoint.yaw = 0.8 * std::sin(0.7 * seconds);
  viewpoint.pitch = -0.1 + 0.15 * std::sin(1.1 * seconds);
  viewpoint.roll = 0.08 * std::sin(0.9 * seconds);
  return viewpoint;
}

Sequence MakeInRoom(const char* name, Viewpoint (*motion)(double), const SequenceOptions& options) {
  constexpr double kFrameRateHz = 30;
  const Camera camera = ChooseCamera(RoomCamera(), options);
  std::vector<SE3> poses;
  for (int i = 0; i < options.frames; ++i)
    poses.push_back(SceneFromCamera(motion(i / kFrameRateHz)));
  return Sequence(name, RoomBuilder().Build(), camera, kFrameRateHz, poses, options);
}

}  // namespace

Sequence MakeRoom(const SequenceOptions& options) { return MakeInRoom("room", WalkAt, options); }

Sequence MakePureRotation(const SequenceOptions& options) {
  return MakeInRoom("rotation", TurnAt, options);
}

}  // namespace corvo::synthetic
