// SPDX-License-Identifier: MIT
#include "orb/patch_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace corvo::orb {
namespace {

/// Returns the gray level at (x, y) of a smooth pattern with texture in every direction.
double Gray(double x, double y) {
  return 128 + 40 * std::sin(0.9 * x + 0.4) * std::cos(0.7 * y) + 30 * std::sin(0.5 * (x + y)) +
         20 * std::cos(0.8 * y - 0.3 * x);
}

/// Renders the pattern around (x, y) through a warp: the pixel at offset u from the center shows
/// the pattern at (x, y) + warp * u.
Patch MakePatch(double x, double y, const PatchWarp& warp = {}, double gain = 1,
                double offset = 0) {
  Patch patch;
  for (int v = -Patch::kRadius; v <= Patch::kRadius; ++v) {
    for (int u = -Patch::kRadius; u <= Patch::kRadius; ++u) {
      const double gray = gain * Gray(x + warp.a * u + warp.b * v, y + warp.c * u + warp.d * v);
      patch.pixels[(v + Patch::kRadius) * Patch::kSide + u + Patch::kRadius] =
          static_cast<std::uint8_t>(std::lround(gray + offset));
    }
  }
  return patch;
}

TEST(PatchAlignmentTest, FindsShifts) {
  for (const double x : {-1.2, -0.4, 0.0, 0.3, 1.0}) {
    for (const double y : {-0.9, 0.0, 0.25, 1.3}) {
      const auto found = AlignPatch(MakePatch(0, 0), MakePatch(-x, -y), {});
      ASSERT_TRUE(found) << x << ' ' << y;
      EXPECT_NEAR(found->x, x, 0.04) << y;
      EXPECT_NEAR(found->y, y, 0.04) << x;
      EXPECT_GT(found->correlation, 0.98);
    }
  }
}

TEST(PatchAlignmentTest, ResultIsInvariantToGainAndOffset) {
  const auto found = AlignPatch(MakePatch(0, 0), MakePatch(-0.6, 0.3, {}, 0.6, 40), PatchWarp());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 0.6, 0.05);
  EXPECT_NEAR(found->y, -0.3, 0.05);
  EXPECT_GT(found->correlation, 0.98);
}

TEST(PatchAlignmentTest, AppliesTheWarp) {
  const PatchWarp warp = {1.15F, -0.3F, 0.25F, 1.1F};
  const double x = 0.5, y = -0.4;  // Position of the center in the target, px.
  const Patch target = MakePatch(-(warp.a * x + warp.b * y), -(warp.c * x + warp.d * y), warp);
  const auto found = AlignPatch(MakePatch(0, 0), target, warp);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, x, 0.05);
  EXPECT_NEAR(found->y, y, 0.05);
}

TEST(PatchAlignmentTest, NothingIsFoundWithoutTexture) {
  Patch flat, edge;
  for (int i = 0; i < Patch::kSide * Patch::kSide; ++i) {
    edge.pixels[i] = i % Patch::kSide < Patch::kRadius ? 50 : 200;
  }
  EXPECT_FALSE(AlignPatch(flat, flat, {}));
  EXPECT_FALSE(AlignPatch(edge, edge, {}));
}

TEST(PatchAlignmentTest, NothingIsFoundOutsideTheSearchRange) {
  EXPECT_FALSE(AlignPatch(MakePatch(0, 0), MakePatch(4.5, 0), {}));
  EXPECT_FALSE(AlignPatch(MakePatch(0, 0), MakePatch(0, 0), {3, 0, 0, 3})) << "beyond the patch";
}

}  // namespace
}  // namespace corvo::orb
