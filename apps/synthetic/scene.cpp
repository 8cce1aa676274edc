// SPDX-License-Identifier: MIT
#include "apps/synthetic/scene.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "apps/synthetic/random.h"

namespace corvo::synthetic {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// Returns the illumination by Lambert's law with a constant ambient part.
double Illumination(const Quad& quad) {
  const Eigen::Vector3d towards_light(0.48, -0.36, 0.8);
  const Eigen::Vector3d normal = -quad.right.cross(quad.down);
  return 0.8 + 0.25 * normal.dot(towards_light);
}

/// Returns the side of a box that faces along `normal`.
Quad Side(const Box& box, const Eigen::Vector3d& normal, double distance, double width) {
  Quad quad;
  quad.right = kUp.cross(normal);
  quad.down = -kUp;
  quad.width = width;
  quad.height = box.size.z();
  quad.corner = box.base + distance * normal - 0.5 * width * quad.right + box.size.z() * kUp;
  quad.texture = box.sides.texture;
  quad.texels_per_meter.setConstant(box.sides.texels_per_meter);
  quad.texture_origin = box.texture_origin;
  quad.texture_origin.y() -= box.size.z() * box.sides.texels_per_meter;
  quad.gain = box.gain;
  return quad;
}

/// Returns the top of a box (`facing` 1) or its bottom (-1), at `height` above its base.
Quad Level(const Box& box, int facing, double height, const Eigen::Vector3d& x_axis,
           const Eigen::Vector3d& y_axis) {
  Quad quad;
  quad.right = x_axis;
  quad.down = -facing * y_axis;
  quad.width = box.size.x();
  quad.height = box.size.y();
  quad.corner = box.base + height * kUp - 0.5 * quad.width * x_axis - 0.5 * quad.height * quad.down;
  quad.texture = box.top.texture;
  quad.texels_per_meter.setConstant(box.top.texels_per_meter);
  quad.texture_origin = box.texture_origin;
  quad.gain = box.gain;
  return quad;
}

std::uint64_t Combine(std::uint64_t hash, double value) {
  return Hash(hash, std::llround(1e6 * value));
}

std::uint64_t Combine(std::uint64_t hash, const Eigen::Vector3d& value) {
  return Combine(Combine(Combine(hash, value.x()), value.y()), value.z());
}

}  // namespace

int Scene::AddTexture(Canvas canvas) {
  textures.emplace_back(std::move(canvas));
  return static_cast<int>(textures.size()) - 1;
}

void Scene::AddLit(Quad quad) {
  quad.gain *= Illumination(quad);
  quads.push_back(quad);
}

void Scene::AddBox(const Box& box) {
  const Eigen::Vector3d x_axis(std::cos(box.yaw), std::sin(box.yaw), 0);
  const Eigen::Vector3d y_axis = kUp.cross(x_axis);
  AddLit(Side(box, -y_axis, 0.5 * box.size.y(), box.size.x()));
  AddLit(Side(box, x_axis, 0.5 * box.size.x(), box.size.y()));
  AddLit(Side(box, y_axis, 0.5 * box.size.y(), box.size.x()));
  AddLit(Side(box, -x_axis, 0.5 * box.size.x(), box.size.y()));
  AddLit(Level(box, 1, box.size.z(), x_axis, y_axis));
  if (box.base.z() > 0) AddLit(Level(box, -1, 0, x_axis, y_axis));
}

std::uint64_t Scene::Fingerprint() const {
  std::uint64_t hash = Combine(0, background);
  for (const Texture& texture : textures) {
    for (const std::uint8_t texel : texture.finest().texels) hash = Mix(hash + kGolden + texel);
  }
  for (const Quad& quad : quads) {
    hash = Combine(Combine(Combine(hash, quad.corner), quad.right), quad.down);
    hash = Combine(Combine(Combine(hash, quad.width), quad.height), quad.gain);
    hash = Combine(Combine(hash, quad.texture_origin.x()), quad.texture_origin.y());
    hash = Combine(Combine(hash, quad.texels_per_meter.x()), quad.texels_per_meter.y());
    hash = Hash(hash, quad.texture);
  }
  return hash;
}

}  // namespace corvo::synthetic
