// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "apps/synthetic/texture.h"

namespace corvo::synthetic {

/// A textured rectangle, visible only from its front. The frame of a scene is in meters with z up.
///
///     x_in_scene = corner + u * right + v * down,  0 <= u <= width, 0 <= v <= height
///     texel = texture_origin + (u * texels_per_meter.x, v * texels_per_meter.y)
struct Quad {
  Eigen::Vector3d corner;  ///< Upper left corner, viewed from the front.
  Eigen::Vector3d right;   ///< Unit vector.
  Eigen::Vector3d down;    ///< Unit vector, orthogonal to `right`.
  double width = 0;        ///< m
  double height = 0;       ///< m
  int texture = 0;         ///< Index into Scene::textures.
  Eigen::Vector2d texture_origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d texels_per_meter = Eigen::Vector2d::Ones();
  double gain = 1;  ///< Factor of the texture's gray.
};

/// A texture and its resolution.
struct Material {
  int texture = 0;
  double texels_per_meter = 100;
};

/// A cuboid that stands on `base`, rotated by `yaw` about the vertical. It has a bottom only if it
/// is above the ground. `texture_origin` is at the lower left corner of each side.
struct Box {
  Eigen::Vector3d base;  ///< Center of the footprint.
  double yaw = 0;        ///< rad
  Eigen::Vector3d size;  ///< Size along the box's x, y and vertical axes, m.
  Material sides;
  Material top;
  Eigen::Vector2d texture_origin = Eigen::Vector2d::Zero();
  double gain = 1;
};

/// The textured surfaces of a scene.
struct Scene {
  std::vector<Texture> textures;
  std::vector<Quad> quads;
  double background = 230;  ///< Gray of pixels without a surface.

  /// Adds a texture and returns its index.
  int AddTexture(Canvas canvas);

  /// Adds a quad whose gain is multiplied by the illumination of its front by a fixed, distant
  /// light.
  void AddLit(Quad quad);

  void AddBox(const Box& box);

  /// Returns a hash that changes with any texel and with any change of a length in a quad by a
  /// micrometer.
  std::uint64_t Fingerprint() const;
};

}  // namespace corvo::synthetic
