// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace corvo::synthetic {

/// A square gray image of 2^n texels on each side, row by row, that repeats in both directions.
struct Canvas {
  explicit Canvas(int side, std::uint8_t value = 128);

  std::uint8_t& At(int x, int y) { return texels[Index(x, y)]; }
  std::uint8_t At(int x, int y) const { return texels[Index(x, y)]; }

  int side;
  std::vector<std::uint8_t> texels;

 private:
  std::size_t Index(int x, int y) const {
    const int mask = side - 1;
    return static_cast<std::size_t>(y & mask) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x & mask);
  }
};

/// A periodic image with its mip-map (Williams 1983), sampled with anisotropic filtering.
/// Texel i covers [i, i + 1) of the continuous coordinate.
class Texture {
 public:
  explicit Texture(Canvas finest);

  /// Returns the mean gray over the parallelogram spanned by the footprint vectors `dx`, `dy`
  /// (texels per pixel) around `position` (texels), from up to kMaxTaps trilinear samples along the
  /// longer vector.
  float Sample(const Eigen::Vector2d& position, const Eigen::Vector2d& dx,
               const Eigen::Vector2d& dy) const;

  int side() const { return levels_.front().side; }
  const Canvas& finest() const { return levels_.front(); }

 private:
  static constexpr int kMaxTaps = 8;

  float Trilinear(const Eigen::Vector2d& position, float level) const;

  std::vector<Canvas> levels_;
};

}  // namespace corvo::synthetic
