// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "apps/synthetic/texture.h"

/// Procedural textures of surfaces. All arithmetic is on integers, so that a seed gives the same
/// texels on every machine. Sizes are in texels.
namespace corvo::synthetic {

/// Draws smooth walls with stains and chipped patches, 1024 on each side.
Canvas DrawPlaster(std::uint64_t seed);

/// Draws bricks of 64x32 with joints, 1024 on each side.
Canvas DrawBricks(std::uint64_t seed);

/// Draws square floor tiles of 128, each with its own gray, 1024 on each side.
Canvas DrawTiles(std::uint64_t seed);

/// Draws wooden boards, 64 wide, with streaks along x, 512 on each side.
Canvas DrawWood(std::uint64_t seed);

/// Draws shelves, 128 high, with the spines of books, 512 on each side.
Canvas DrawBooks(std::uint64_t seed);

/// Draws a poster with shapes and lines of text, 512 on each side.
Canvas DrawPoster(std::uint64_t seed);

/// Draws a wall of bricks or plaster with rows of windows, 256 apart, and doors in the lowest row,
/// 1024 on each side. The ground is at y = 0.
Canvas DrawFacade(std::uint64_t seed);

/// Draws a road with grain, tar patches, cracks and covers, 2048 on each side.
Canvas DrawAsphalt(std::uint64_t seed);

/// Draws paving stones of 32, 512 on each side.
Canvas DrawPaving(std::uint64_t seed);

/// Draws leaves, 512 on each side.
Canvas DrawFoliage(std::uint64_t seed);

/// Draws sheet metal with panes, seams and lettering, for vehicles and cupboards, 512 on each side.
Canvas DrawPanel(std::uint64_t seed);

/// Draws bricks with posters, stickers and stains in one plane, 2048 on each side.
Canvas DrawMural(std::uint64_t seed);

}  // namespace corvo::synthetic
