// SPDX-License-Identifier: MIT
#include "apps/synthetic/boards.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "apps/synthetic/materials.h"
#include "orb/error.h"

namespace corvo::synthetic {
namespace {

constexpr int kBoards = 3;
constexpr double kBoardHeight = 0.9;  ///< Height of a board as a fraction of its image row.
constexpr double kDepth = 0.8;        ///< m
constexpr double kPeriodsS[kBoards] = {5.3, 4.1, 6.7};

Eigen::Vector2d RayThrough(const Camera& camera, double x, double y) {
  const auto ray = camera.Undistort({x, y});
  if (!ray)
    throw Error("moving_share: the camera has no ray through the middle of its image border");
  return *ray;
}

}  // namespace

Boards::Boards(const Camera& camera, double share, Scene* scene) : width_(share / kBoardHeight) {
  const double x = 0.5 * (camera.width() - 1), y = 0.5 * (camera.height() - 1);
  corner_ = {RayThrough(camera, -0.5, y).x(), RayThrough(camera, x, -0.5).y()};
  image_ = Eigen::Vector2d(RayThrough(camera, camera.width() - 0.5, y).x(),
                           RayThrough(camera, x, camera.height() - 0.5).y()) -
           corner_;
  for (int i = 0; i < kBoards; ++i) {
    textures_.push_back(scene->AddTexture(DrawPoster(51 + static_cast<std::uint64_t>(i))));
  }
}

std::vector<Quad> Boards::At(const SE3& scene_from_camera, double seconds) const {
  std::vector<Quad> quads;
  for (int i = 0; i < kBoards; ++i) {
    const double phase = 2 * std::numbers::pi * seconds / kPeriodsS[i] + 2.1 * i;
    const double left = (1 - width_) * 0.5 * (1 + std::sin(phase));
    const double top = (i + 0.5 * (1 - kBoardHeight)) / kBoards;
    const Eigen::Vector2d ray = corner_ + image_.cwiseProduct(Eigen::Vector2d(left, top));
    Quad quad;
    quad.corner = scene_from_camera * Eigen::Vector3d(kDepth * ray.homogeneous());
    quad.right = scene_from_camera.rotation() * Eigen::Vector3d::UnitX();
    quad.down = scene_from_camera.rotation() * Eigen::Vector3d::UnitY();
    quad.width = kDepth * width_ * image_.x();
    quad.height = kDepth * kBoardHeight / kBoards * image_.y();
    quad.texture = textures_[static_cast<std::size_t>(i)];
    quad.texels_per_meter.setConstant(512 / std::max(quad.width, quad.height));
    quads.push_back(quad);
  }
  return quads;
}

}  // namespace corvo::synthetic
