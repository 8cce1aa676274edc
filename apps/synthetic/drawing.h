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

/// Value noise: lattices of hashed values, smoothly interpolated, of cell size `coarsest`, half of
/// that, and so on to `finest` (powers of two); `amplitude` grays in the coarsest, 3/4 as much in
/// each one after it.
struct Noise {
  int coarsest, finest, amplitude;
};
void AddNoise(Canvas* canvas, std::uint64_t seed, const Noise& noise);

void Fill(Canvas* canvas, const Rectangle& area, int gray);
void Add(Canvas* canvas, const Rectangle& area, int grays);
void Fill(Canvas* canvas, const Disc& area, int gray);

/// A random walk of `length` steps, `thickness` texels thick.
void DrawCrack(Canvas* canvas, Random* random, int length, int thickness, int gray);

/// Lines of glyphs, each a random bitmap of 3x5 dots of `dot` texels.
void DrawText(Canvas* canvas, Random* random, const Rectangle& area, int dot, int gray);

}  // namespace corvo::synthetic
