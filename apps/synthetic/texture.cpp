// SPDX-License-Identifier: MIT
#include "apps/synthetic/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace corvo::synthetic {
namespace {

Canvas Halve(const Canvas& fine) {
  Canvas coarse(fine.side / 2);
  for (int y = 0; y < coarse.side; ++y) {
    for (int x = 0; x < coarse.side; ++x) {
      const int sum = fine.At(2 * x, 2 * y) + fine.At(2 * x + 1, 2 * y) +
                      fine.At(2 * x, 2 * y + 1) + fine.At(2 * x + 1, 2 * y + 1);
      coarse.At(x, y) = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
  return coarse;
}

float Bilinear(const Canvas& canvas, double x, double y) {
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const float u = static_cast<float>(x - 0.5 - left), v = static_cast<float>(y - 0.5 - top);
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const float upper = (1 - u) * canvas.At(column, row) + u * canvas.At(column + 1, row);
  const float lower = (1 - u) * canvas.At(column, row + 1) + u * canvas.At(column + 1, row + 1);
  return (1 - v) * upper + v * lower;
}

}  // namespace

Canvas::Canvas(int side_texels, std::uint8_t value)
    : side(side_texels),
      texels(static_cast<std::size_t>(side_texels) * static_cast<std::size_t>(side_texels), value) {
}

Texture::Texture(Canvas finest) {
  levels_.push_back(std::move(finest));
  while (levels_.back().side > 1) levels_.push_back(Halve(levels_.back()));
}

float Texture::Sample(const Eigen::Vector2d& position, const Eigen::Vector2d& dx,
                      const Eigen::Vector2d& dy) const {
  const double length_x = dx.norm(), length_y = dy.norm();
  const Eigen::Vector2d& axis = length_x > length_y ? dx : dy;
  const double longer = std::max(length_x, length_y);
  const double shorter = std::max(std::min(length_x, length_y), 1.0);
  const int taps = static_cast<int>(std::clamp(std::ceil(longer / shorter), 1.0, double{kMaxTaps}));
  const float level = std::log2(std::max(static_cast<float>(longer / taps), 1.0f));
  float sum = 0;
  for (int i = 0; i < taps; ++i) {
    sum += Trilinear(position + ((i + 0.5) / taps - 0.5) * axis, level);
  }
  return sum / static_cast<float>(taps);
}

float Texture::Trilinear(const Eigen::Vector2d& position, float level) const {
  const std::size_t last = levels_.size() - 1;
  const std::size_t fine = std::min(static_cast<std::size_t>(level), last);
  const double scale = 1.0 / static_cast<double>(std::size_t{1} << fine);
  const float sharp = Bilinear(levels_[fine], scale * position.x(), scale * position.y());
  const float blend = level - static_cast<float>(fine);
  if (blend <= 0 || fine == last) return sharp;
  const double half = 0.5 * scale;
  const float soft = Bilinear(levels_[fine + 1], half * position.x(), half * position.y());
  return (1 - blend) * sharp + blend * soft;
}

}  // namespace corvo::synthetic
