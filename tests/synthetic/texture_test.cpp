// SPDX-License-Identifier: MIT
#include "apps/synthetic/texture.h"

#include <gmock/gmock.h>

#include "apps/synthetic/materials.h"
#include "apps/synthetic/random.h"

namespace corvo::synthetic {
namespace {

using Eigen::Vector2d;

const Vector2d kPointlike = Vector2d::Zero();

Canvas RandomCanvas(int side) {
  Canvas canvas(side);
  for (std::size_t i = 0; i < canvas.texels.size(); ++i) {
    canvas.texels[i] = static_cast<std::uint8_t>(Hash(3, static_cast<std::int64_t>(i)));
  }
  return canvas;
}

TEST(Texture, IsExactAtTexelCenters) {
  const Canvas canvas = RandomCanvas(16);
  const Texture texture(canvas);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(texture.Sample({x + 0.5, y + 0.5}, kPointlike, kPointlike), canvas.At(x, y));
    }
  }
}

TEST(Texture, InterpolatesBetweenTexelCenters) {
  const Canvas canvas = RandomCanvas(16);
  const Texture texture(canvas);
  const float expected = 0.75f * canvas.At(4, 7) + 0.25f * canvas.At(5, 7);
  EXPECT_NEAR(texture.Sample({4.75, 7.5}, kPointlike, kPointlike), expected, 1e-4);
}

TEST(Texture, RepeatsPeriodically) {
  const Texture texture(RandomCanvas(16));
  const Vector2d dx(1.5, 0.2), dy(-0.1, 3.0);
  const float here = texture.Sample({3.2, 9.9}, dx, dy);
  EXPECT_NEAR(texture.Sample({3.2 + 16, 9.9 - 32}, dx, dy), here, 1e-4);
}

TEST(Texture, AveragesOverTheFootprint) {
  Canvas checkers(64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) checkers.At(x, y) = (x + y) % 2 == 0 ? 40 : 200;
  }
  const Texture texture(checkers);
  EXPECT_NEAR(texture.Sample({10.5, 10.5}, {2, 0}, {0, 2}), 120, 1);
  EXPECT_NEAR(texture.Sample({10.5, 10.5}, {500, 0}, {0, 500}), 120, 1);
}

/// The stripes run along x: a footprint that is long in x must not blur them, one that is long in y
/// must.
TEST(Texture, FiltersAlongTheLongAxisOnly) {
  Canvas stripes(64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) stripes.At(x, y) = y / 4 % 2 == 0 ? 40 : 200;
  }
  const Texture texture(stripes);
  EXPECT_NEAR(texture.Sample({10.5, 2}, {6, 0}, {0, 1}), 40, 1);
  EXPECT_NEAR(texture.Sample({10.5, 2}, {1, 0}, {0, 8}), 120, 20);
}

TEST(Materials, DependOnTheSeedOnly) {
  EXPECT_EQ(DrawPlaster(1).texels, DrawPlaster(1).texels);
  EXPECT_NE(DrawPlaster(1).texels, DrawPlaster(2).texels);
}

}  // namespace
}  // namespace corvo::synthetic
