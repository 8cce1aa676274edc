// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "apps/synthetic/random.h"
#include "apps/synthetic/texture.h"

/// Integer drawing on a periodic canvas. Grays outside 0 to 255 are clamped.
namespace corvo::synthetic {

struct Rectangle {
  int x, y, width, height;
};

struct Disc {
  int x, y, radius;
};

/// Value noise: a sum of smoothly interpolated lattices of hashed values, with cell sizes from
/// `coarsest`, halved repeatedly, to `finest` (powers of two). The amplitude is `amplitude` grays
/// in the coarsest lattice and 3/4 of the previous one in each finer lattice.
struct Noise {
  int coarsest, finest, amplitude;
};
void AddNoise(Canvas* canvas, std::uint64_t seed, const Noise& noise);

void Fill(Canvas* canvas, const Rectangle& area, int gray);
void Add(Canvas* canvas, const Rectangle& area, int grays);
void Fill(Canvas* canvas, const Disc& area, int gray);

/// Draws a random walk of `length` steps, `thickness` texels thick.
void DrawCrack(Canvas* canvas, Random* random, int length, int thickness, int gray);

/// Draws lines of glyphs, each of which is a random bitmap of 3x5 dots of `dot` texels.
void DrawText(Canvas* canvas, Random* random, const Rectangle& area, int dot, int gray);

}  // namespace corvo::synthetic
