// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/motion.h"
#include "apps/synthetic/random.h"
#include "apps/synthetic/sequence.h"
#include "apps/synthetic/street_path.h"

namespace corvo::synthetic {
namespace {

constexpr double kStride = 0.8;         ///< Distance between frames on a straight, m.
constexpr double kCameraHeight = 1.65;  ///< m
constexpr double kSight = 250;          ///< Length of the street beyond the last frame, m.
constexpr double kKerb = 5.2;      ///< Distance from the middle of the road to the pavement, m.
constexpr double kShortest = 450;  ///< Minimum length of the street, m.

CameraParameters StreetCamera() {
  CameraParameters camera;
  camera.width = 1241;
  camera.height = 376;
  camera.fx = camera.fy = 718;
  camera.cx = 607;
  camera.cy = 185;
  return camera;
}

/// Lines a path with houses, trees, poles and parked vehicles. The objects at a place do not depend
/// on the length of the street.
class StreetBuilder {
 public:
  explicit StreetBuilder(const StreetPath& path) : path_(path) {}

  std::shared_ptr<const Scene> Build() {
    AddMaterials();
    AddGround();
    for (const int side : {-1, 1}) {
      AddHouses(side);
      AddPavement(side);
      AddRow(side, 4.1, 9.0, 3, &StreetBuilder::AddVehicle);
      AddRow(side, 6.0, 17.0, 5, &StreetBuilder::AddTree);
      AddRow(side, 5.6, 23.0, 7, &StreetBuilder::AddPole);
    }
    return scene_;
  }

 private:
  using AddObject = void (StreetBuilder::*)(const StreetPath::Place&, const Eigen::Vector2d&,
                                            Random*);

  Material NewMaterial(Canvas canvas, double texels_per_meter) {
    return {scene_->AddTexture(std::move(canvas)), texels_per_meter};
  }

  void AddMaterials() {
    for (std::uint64_t i = 0; i < 8; ++i) facades_.push_back(NewMaterial(DrawFacade(40 + i), 80));
    for (std::uint64_t i = 0; i < 3; ++i) panels_.push_back(NewMaterial(DrawPanel(50 + i), 128));
    asphalt_ = NewMaterial(DrawAsphalt(60), 60);
    paving_ = NewMaterial(DrawPaving(61), 80);
    foliage_ = NewMaterial(DrawFoliage(62), 130);
    wood_ = NewMaterial(DrawWood(63), 200);
    poster_ = NewMaterial(DrawPoster(64), 400);
  }

  void AddGround() {
    constexpr double kHalf = 20000;
    Quad ground;
    ground.corner = Eigen::Vector3d(-kHalf, kHalf, 0);
    ground.right = Eigen::Vector3d::UnitX();
    ground.down = -Eigen::Vector3d::UnitY();
    ground.width = ground.height = 2 * kHalf;
    ground.texture = asphalt_.texture;
    ground.texels_per_meter.setConstant(asphalt_.texels_per_meter);
    scene_->AddLit(ground);
  }

  /// Returns whether a rectangle around `center` keeps `margin` from the middle of the road.
  bool IsClear(const Eigen::Vector2d& center, double yaw, const Eigen::Vector2d& size, double along,
               double margin) const {
    const Eigen::Rotation2Dd turn(yaw);
    for (int i = 0; i < 9; ++i) {
      const int column = i % 3 - 1, row = i / 3 - 1;
      const Eigen::Vector2d corner(0.5 * column * size.x(), 0.5 * row * size.y());
      const Eigen::Vector2d point = center + turn * corner;
      if (path_.Clearance(point, along - 60, along + 60) < margin) return false;
    }
    return true;
  }

  /// Returns the distance along the road after `meters` more along the parallel line, `left` meters
  /// beside the road.
  double Advance(double along, double left, double meters) const {
    for (double done = 0; done < meters && along < path_.length(); along += 0.5) {
      done += 0.5 * std::max(0.1, 1 - left * path_.At(along).curvature);
    }
    return along;
  }

  void AddHouses(int side) {
    double along = side > 0 ? -4 : -9;
    for (int number = 0; along < path_.length(); ++number) {
      Random random(Hash(70, side, number));
      const double width = random.Uniform(9, 15), depth = random.Uniform(8, 11);
      const double setback = random.Uniform(8.6, 11);
      const double middle = Advance(along, side * setback, width / 2);
      const StreetPath::Place place = path_.At(middle);
      const Eigen::Vector2d center = place.Inflated(side * (setback + depth / 2));
      if (IsClear(center, place.heading, {width, depth}, middle, 8.2)) {
        AddHouse(center, place.heading, {width, depth, random.Uniform(6, 12)}, side, &random);
      }
      along = Advance(along, side * setback, width + (random.Chance(25) ? 3.0 : 0.2));
    }
  }

  void AddHouse(const Eigen::Vector2d& center, double heading, const Eigen::Vector3d& size,
                int side, Random* random) {
    const Material& facade = Pick(facades_, random);
    const Eigen::Vector2d origin(256.0 * random->Between(0, 3), 0);
    const double gain = random->Uniform(0.8, 1.15);
    scene_->AddBox({{center.x(), center.y(), 0}, heading, size, facade, paving_, origin, gain});
    const Eigen::Rotation2Dd turn(heading);
    for (int i = random->Between(0, 2); i > 0; --i) {  // Bays.
      const Eigen::Vector3d bay{random->Uniform(1.8, 3), random->Uniform(0.5, 1.2),
                                random->Uniform(2.8, size.z() - 1)};
      const double along = random->Uniform(bay.x() - size.x(), size.x() - bay.x()) / 2;
      const Eigen::Vector2d base =
          center + turn * Eigen::Vector2d(along, -side * (size.y() + bay.y()) / 2);
      const Eigen::Vector2d bay_origin(random->Between(0, 1023), 0);
      scene_->AddBox({{base.x(), base.y(), 0},
                      heading,
                      bay,
                      Pick(facades_, random),
                      paving_,
                      bay_origin,
                      gain});
    }
  }

  /// Adds a pavement of slightly overlapping pieces. Every second piece is higher, so that no two
  /// surfaces coincide.
  void AddPavement(int side) {
    constexpr double kPiece = 2.0, kBreadth = 2.6;
    for (int i = 0; i * kPiece < path_.length(); ++i) {
      const double along = i * kPiece, rise = i % 2 == 0 ? 0.130 : 0.133;
      const StreetPath::Place place = path_.At(along + kPiece / 2);
      const double left = side * (kKerb + kBreadth / 2);
      const double length = kPiece * (1 - left * place.curvature) + 0.02;
      const Eigen::Vector2d center = place.Inflated(left);
      const Eigen::Vector2d origin(along * paving_.texels_per_meter, 0);
      scene_->AddBox({{center.x(), center.y(), 0},
                      place.heading,
                      {length, kBreadth, rise},
                      paving_,
                      paving_,
                      origin,
                      1.0});
    }
  }

  /// Adds an object about every `spacing` meters, `aside` from the middle of the road.
  void AddRow(int side, double aside, double spacing, std::uint64_t seed, AddObject add) {
    for (int i = 0; i * spacing < path_.length(); ++i) {
      Random random(Hash(seed, side, i));
      if (random.Chance(30)) continue;
      const double along = spacing * (i + random.Uniform(0.2, 0.8));
      const StreetPath::Place place = path_.At(along);
      const Eigen::Vector2d position = place.Inflated(side * (aside + random.Uniform(0, 0.4)));
      (this->*add)(place, position, &random);
    }
  }

  void AddVehicle(const StreetPath::Place& place, const Eigen::Vector2d& position, Random* random) {
    const double yaw = place.heading + random->Uniform(-0.04, 0.04),
                 gain = random->Uniform(0.6, 1.2);
    const Eigen::Vector2d origin(random->Between(0, 511), 0);
    const Eigen::Vector3d base(position.x(), position.y(), 0);
    const Material& panel = Pick(panels_, random);
    if (random->Chance(25)) {
      scene_->AddBox({base, yaw, {4.8, 1.8, 2.3}, panel, panel, origin, gain});
      return;
    }
    scene_->AddBox({base, yaw, {4.2, 1.7, 0.9}, panel, panel, origin, gain});
    const Eigen::Vector3d roof = base + Eigen::Vector3d(0, 0, 0.9);
    scene_->AddBox(
        {roof, yaw, {2.2, 1.5, 0.55}, panel, panel, origin + Eigen::Vector2d(0, 180), gain});
  }

  void AddTree(const StreetPath::Place& place, const Eigen::Vector2d& position, Random* random) {
    const double trunk = random->Uniform(1.8, 2.6);
    const Eigen::Vector3d base(position.x(), position.y(), 0);
    const Eigen::Vector2d origin{random->Uniform(0, 512), random->Uniform(0, 512)};
    scene_->AddBox({base, place.heading, {0.3, 0.3, trunk}, foliage_, foliage_, origin, 0.7});
    double width = random->Uniform(1.9, 3.0), height = trunk;
    for (int i = 0; i < 3; ++i) {
      const double thickness = random->Uniform(0.6, 1.2);
      scene_->AddBox({base + Eigen::Vector3d(0, 0, height),
                      random->Uniform(0, 1.5),
                      {width, width, thickness},
                      foliage_,
                      foliage_,
                      origin,
                      1.0});
      height += thickness;
      width *= random->Uniform(0.55, 0.9);
    }
  }

  void AddPole(const StreetPath::Place& place, const Eigen::Vector2d& position, Random* random) {
    const Eigen::Vector3d base(position.x(), position.y(), 0);
    const Eigen::Vector2d origin{random->Uniform(0, 512), random->Uniform(0, 512)};
    scene_->AddBox(
        {base, place.heading, {0.18, 0.18, random->Uniform(4, 6)}, wood_, wood_, origin, 0.9});
    const Eigen::Vector3d sign = base + Eigen::Vector3d(0, 0, random->Uniform(2.2, 2.8));
    scene_->AddBox({sign, place.heading, {0.2, 0.75, 0.75}, poster_, poster_, origin, 1.0});
  }

  static const Material& Pick(const std::vector<Material>& materials, Random* random) {
    return materials[static_cast<std::size_t>(
        random->Between(0, static_cast<int>(materials.size()) - 1))];
  }

  const StreetPath& path_;
  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
  std::vector<Material> facades_, panels_;
  Material asphalt_, paving_, foliage_, wood_, poster_;
};

/// Returns the distances along the road at the frames. The car is slower in bends.
std::vector<double> Drive(int frames) {
  const StreetPath path(kStride * frames + 1);
  std::vector<double> distances = {0};
  while (static_cast<int>(distances.size()) < frames) {
    const double curvature = std::abs(path.At(distances.back()).curvature);
    distances.push_back(distances.back() + kStride / (1 + 6 * curvature));
  }
  return distances;
}

/// Returns the viewpoint of the camera on a slightly rocking car.
Viewpoint DriveAt(const StreetPath::Place& place, double distance) {
  Viewpoint viewpoint;
  viewpoint.position << place.position, kCameraHeight + 0.012 * std::sin(0.9 * distance);
  viewpoint.yaw = place.heading + 0.002 * std::sin(0.31 * distance);
  viewpoint.pitch = 0.004 * std::sin(1.3 * distance) + 0.003 * std::sin(0.47 * distance + 1);
  viewpoint.roll = 0.004 * std::sin(0.7 * distance) + 0.1 * place.curvature;
  return viewpoint;
}

}  // namespace

Sequence MakeStreet(const SequenceOptions& options) {
  constexpr double kFrameRateHz = 10;
  const Camera camera = ChooseCamera(StreetCamera(), options);
  const std::vector<double> distances = Drive(options.frames);
  const StreetPath path(std::max(kShortest, distances.back() + kSight));
  std::vector<SE3> poses;
  for (const double distance : distances) {
    poses.push_back(SceneFromCamera(DriveAt(path.At(distance), distance)));
  }
  return Sequence("street", StreetBuilder(path).Build(), camera, kFrameRateHz, poses, options);
}

}  // namespace corvo::synthetic
