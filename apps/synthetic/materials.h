// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "apps/synthetic/texture.h"

/// Procedural images of surfaces. All arithmetic is on integers, so that every machine draws the
/// same texels for a seed. Sizes are in texels.
namespace corvo::synthetic {

/// Smooth walls with stains and chipped patches. 1024 a side.
Canvas DrawPlaster(std::uint64_t seed);

/// Bricks of 64x32 with joints. 1024 a side.
Canvas DrawBricks(std::uint64_t seed);

/// Square floor tiles of 128, each of its own gray. 1024 a side.
Canvas DrawTiles(std::uint64_t seed);

/// Wooden boards 64 wide with streaks along x. 512 a side.
Canvas DrawWood(std::uint64_t seed);

/// Shelves 128 high with the backs of books. 512 a side.
Canvas DrawBooks(std::uint64_t seed);

/// A poster: shapes and lines of text. 512 a side.
Canvas DrawPoster(std::uint64_t seed);

/// A wall of bricks or plaster with rows of windows 256 apart, doors in the lowest row. The ground
/// is at y = 0. 1024 a side.
Canvas DrawFacade(std::uint64_t seed);

/// A road: grain, tar patches, cracks, covers. 2048 a side.
Canvas DrawAsphalt(std::uint64_t seed);

/// Paving stones of 32, 512 a side.
Canvas DrawPaving(std::uint64_t seed);

/// Leaves. 512 a side.
Canvas DrawFoliage(std::uint64_t seed);

/// Sheet metal with panes, seams and lettering: vehicles, cupboards. 512 a side.
Canvas DrawPanel(std::uint64_t seed);

/// Bricks with posters, stickers and stains in one plane. 2048 a side.
Canvas DrawMural(std::uint64_t seed);

}  // namespace corvo::synthetic
