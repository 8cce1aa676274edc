// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "apps/synthetic/texture.h"

namespace corvo::synthetic {

/// A textured rectangle, seen from its front only. The frame of a scene is in meters with z up.
///
///     x_in_scene = corner + u * right + v * down,  0 <= u <= width, 0 <= v <= height
///     texel = texture_origin + (u * texels_per_meter.x, v * texels_per_meter.y)
struct Quad {
  Eigen::Vector3d corner;  ///< The upper left one, seen from the front.
  Eigen::Vector3d right;   ///< Unit vector.
  Eigen::Vector3d down;    ///< Unit vector, orthogonal to `right`.
  double width = 0;        ///< m
  double height = 0;       ///< m
  int texture = 0;         ///< Index into Scene::textures.
  Eigen::Vector2d texture_origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d texels_per_meter = Eigen::Vector2d::Ones();
  double gain = 1;  ///< Brightness of the surface, times its texture's gray.
};

/// A texture at a size.
struct Material {
  int texture = 0;
  double texels_per_meter = 100;
};

/// A cuboid that stands on `base`, turned by `yaw` about the vertical. It has a bottom only if it
/// is above the ground; the texture of each side starts at `texture_origin` at its lower left
/// corner.
struct Box {
  Eigen::Vector3d base;  ///< Center of the footprint.
  double yaw = 0;        ///< rad
  Eigen::Vector3d size;  ///< Along the box's own x, y and up, m.
  Material sides;
  Material top;
  Eigen::Vector2d texture_origin = Eigen::Vector2d::Zero();
  double gain = 1;
};

/// What there is to see.
struct Scene {
  std::vector<Texture> textures;
  std::vector<Quad> quads;
  double background = 230;  ///< Gray where no surface is.

  /// The index of the new texture.
  int AddTexture(Canvas canvas);

  /// Adds a quad, its gain multiplied by how much of a fixed, distant light its front receives.
  void AddLit(Quad quad);

  void AddBox(const Box& box);

  /// A number that changes with any texel, and with any length in a quad by a micrometer.
  std::uint64_t Fingerprint() const;
};

}  // namespace corvo::synthetic
