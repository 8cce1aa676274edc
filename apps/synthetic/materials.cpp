// SPDX-License-Identifier: MIT
#include "apps/synthetic/materials.h"

#include <algorithm>

#include "apps/synthetic/drawing.h"

namespace corvo::synthetic {
namespace {

/// Rows of blocks, every second row shifted by half a block; each block has its own gray.
struct Masonry {
  int width, height, joint;
  int darkest, lightest, joint_gray;
  bool shifted;
};

void DrawMasonry(Canvas* canvas, std::uint64_t seed, const Masonry& masonry) {
  Fill(canvas, Rectangle{0, 0, canvas->side, canvas->side}, masonry.joint_gray);
  const int rows = canvas->side / masonry.height, columns = canvas->side / masonry.width;
  for (int row = 0; row < rows; ++row) {
    const int shift = masonry.shifted && row % 2 == 1 ? masonry.width / 2 : 0;
    for (int column = 0; column < columns; ++column) {
      Random random(Hash(seed, column, row));
      Fill(canvas,
           {column * masonry.width + shift, row * masonry.height, masonry.width - masonry.joint,
            masonry.height - masonry.joint},
           random.Between(masonry.darkest, masonry.lightest));
    }
  }
}

/// Adds `count` rectangles of random position, size and gray to the canvas.
void AddPatches(Canvas* canvas, Random* random, int count, int smallest, int largest, int grays) {
  for (int i = 0; i < count; ++i) {
    const int x = random->Between(0, canvas->side - 1), y = random->Between(0, canvas->side - 1);
    const int width = random->Between(smallest, largest);
    const int height = random->Between(smallest, largest);
    Add(canvas, Rectangle{x, y, width, height}, random->Between(-grays, grays));
  }
}

/// Adds many small marks of low contrast and a fine mottling, as on real surfaces.
void AddWear(Canvas* canvas, std::uint64_t seed, int marks_per_square, int grays) {
  Random random(Hash(seed, 1));
  const int squares = canvas->side / 64 * (canvas->side / 64);
  AddPatches(canvas, &random, squares * marks_per_square, 2, 7, grays);
  AddNoise(canvas, Hash(seed, 2), {16, 4, grays / 4});
}

void DrawWindow(Canvas* canvas, Random* random, const Rectangle& area) {
  const int frame = random->Between(180, 235), pane = random->Between(20, 70);
  Add(canvas, Rectangle{area.x - 10, area.y - 10, area.width + 20, area.height + 20}, -25);
  Fill(canvas, area, frame);
  const int columns = random->Between(1, 2), rows = random->Between(1, 3), bar = 6;
  const int width = (area.width - bar) / columns, height = (area.height - bar) / rows;
  for (int i = 0; i < columns * rows; ++i) {
    const Rectangle glass = {area.x + bar + i % columns * width,
                             area.y + bar + i / columns * height, width - bar, height - bar};
    Fill(canvas, glass, pane + random->Between(-12, 12));
    if (random->Chance(40)) {
      const int drawn = random->Between(glass.width / 5, glass.width / 2);
      Fill(canvas, Rectangle{glass.x, glass.y, drawn, glass.height}, random->Between(110, 190));
    }
  }
  Fill(canvas, Rectangle{area.x - 8, area.y + area.height, area.width + 16, 10},
       random->Between(150, 220));
}

void DrawDoor(Canvas* canvas, Random* random, const Rectangle& area) {
  const int gray = random->Between(30, 110);
  Fill(canvas, Rectangle{area.x - 8, area.y - 8, area.width + 16, area.height + 8}, 200);
  Fill(canvas, area, gray);
  Fill(canvas, Rectangle{area.x + 10, area.y + 12, area.width - 20, area.height / 3}, gray + 40);
  Fill(canvas, Rectangle{area.x + 10, area.y + area.height / 2, area.width - 20, area.height / 3},
       gray - 15);
  Fill(canvas, Disc{area.x + area.width - 8, area.y + area.height / 2, 3}, 220);
}

/// Draws one cell of a facade, 256x256. `floor` counts from the ground; y points downwards.
void DrawFacadeCell(Canvas* canvas, Random* random, int column, int floor) {
  const int x = 256 * column, y = -256 * (floor + 1);
  if (floor == 0 && random->Chance(45)) {
    DrawDoor(canvas, random, {x + random->Between(50, 110), y + 76, 80, 180});
    DrawText(canvas, random, {x + 40, y + 20, 180, 26}, 5, random->Between(0, 1) * 230);
    return;
  }
  const int width = random->Between(80, 150), height = random->Between(100, 140);
  DrawWindow(canvas, random, {x + 128 - width / 2, y + random->Between(45, 75), width, height});
}

void DrawPosterAt(Canvas* canvas, Random* random, const Rectangle& area) {
  Fill(canvas, area, random->Between(150, 240));
  for (int i = random->Between(4, 8); i > 0; --i) {
    const int width = random->Between(area.width / 12, area.width / 2);
    const int height = random->Between(area.height / 12, area.height / 3);
    const int x = area.x + random->Between(0, area.width - width);
    const int y = area.y + random->Between(0, area.height - height);
    Fill(canvas, Rectangle{x, y, width, height}, random->Between(10, 245));
  }
  const int radius = std::min(area.width, area.height) / 10;
  for (int i = random->Between(1, 4); i > 0; --i) {
    const Disc disc = {area.x + random->Between(radius, area.width - radius),
                       area.y + random->Between(radius, area.height - radius),
                       random->Between(radius / 3, radius)};
    Fill(canvas, disc, random->Between(10, 245));
  }
  const Rectangle text = {area.x + area.width / 10, area.y + area.height * 2 / 3,
                          area.width * 4 / 5, area.height / 4};
  Fill(canvas, text, 225);
  DrawText(canvas, random, text, std::max(area.width / 90, 2), 40);
}

}  // namespace

Canvas DrawPlaster(std::uint64_t seed) {
  Canvas canvas(1024, 165);
  Random random(seed);
  AddPatches(&canvas, &random, 40, 20, 120, 18);
  AddPatches(&canvas, &random, 260, 3, 14, 70);
  for (int i = 0; i < 8; ++i) DrawCrack(&canvas, &random, 300, 2, 90);
  AddNoise(&canvas, seed, {256, 2, 22});
  AddWear(&canvas, seed, 3, 45);
  return canvas;
}

Canvas DrawBricks(std::uint64_t seed) {
  Canvas canvas(1024);
  Random random(seed);
  DrawMasonry(&canvas, seed, {64, 32, 4, 85, 150, 185, true});
  AddPatches(&canvas, &random, 200, 4, 20, 50);
  AddNoise(&canvas, seed, {128, 2, 18});
  AddWear(&canvas, seed, 4, 45);
  return canvas;
}

Canvas DrawTiles(std::uint64_t seed) {
  Canvas canvas(1024);
  Random random(seed);
  DrawMasonry(&canvas, seed, {128, 128, 5, 90, 190, 60, false});
  AddPatches(&canvas, &random, 300, 4, 24, 40);
  AddNoise(&canvas, seed, {64, 2, 18});
  AddWear(&canvas, seed, 3, 40);
  return canvas;
}

Canvas DrawWood(std::uint64_t seed) {
  Canvas canvas(512);
  Random random(seed);
  DrawMasonry(&canvas, seed, {256, 64, 3, 95, 160, 50, true});
  for (int i = 0; i < 250; ++i) {
    const Rectangle streak = {random.Between(0, 511), random.Between(0, 511),
                              random.Between(30, 120), random.Between(1, 3)};
    Add(&canvas, streak, random.Between(-35, 25));
  }
  for (int i = 0; i < 25; ++i) {
    Fill(&canvas, Disc{random.Between(0, 511), random.Between(0, 511), random.Between(3, 8)}, 60);
  }
  AddNoise(&canvas, seed, {64, 2, 14});
  AddWear(&canvas, seed, 4, 35);
  return canvas;
}

Canvas DrawBooks(std::uint64_t seed) {
  Canvas canvas(512, 35);
  Random random(seed);
  for (int shelf = 0; shelf < 4; ++shelf) {
    const int bottom = 128 * (shelf + 1) - 10;
    for (int x = 0; x < 500;) {
      const int width = std::min(random.Between(9, 30), 512 - x), height = random.Between(75, 112);
      Fill(&canvas, Rectangle{x, bottom - height, width - 1, height}, random.Between(50, 230));
      const Rectangle band = {x, bottom - height + random.Between(8, 20), width - 1,
                              random.Between(4, 14)};
      Fill(&canvas, band, random.Between(20, 245));
      if (width > 14) {
        DrawText(&canvas, &random, {x + 3, bottom - height / 2, width - 6, height / 3}, 2, 240);
      }
      x += width;
    }
    Fill(&canvas, Rectangle{0, bottom, 512, 10}, 140);
  }
  AddNoise(&canvas, seed, {64, 4, 8});
  return canvas;
}

Canvas DrawPoster(std::uint64_t seed) {
  Canvas canvas(512);
  Random random(seed);
  DrawPosterAt(&canvas, &random, {0, 0, 512, 512});
  AddNoise(&canvas, seed, {128, 4, 8});
  return canvas;
}

Canvas DrawFacade(std::uint64_t seed) {
  Canvas canvas(1024);
  Random random(seed);
  if (random.Chance(50)) {
    DrawMasonry(&canvas, seed, {32, 16, 2, 95, 150, 175, true});
  } else {
    Fill(&canvas, Rectangle{0, 0, 1024, 1024}, random.Between(120, 190));
  }
  AddPatches(&canvas, &random, 60, 10, 90, 20);
  AddPatches(&canvas, &random, 150, 3, 10, 45);
  AddNoise(&canvas, seed, {256, 2, 14});
  AddWear(&canvas, seed, 16, 60);
  for (int cell = 0; cell < 16; ++cell) DrawFacadeCell(&canvas, &random, cell % 4, cell / 4);
  Fill(&canvas, Rectangle{0, -260, 1024, 6}, random.Between(60, 220));
  Add(&canvas, Rectangle{0, -30, 1024, 30}, -40);
  return canvas;
}

Canvas DrawAsphalt(std::uint64_t seed) {
  Canvas canvas(2048, 105);
  Random random(seed);
  AddPatches(&canvas, &random, 60, 40, 220, 16);
  for (int i = 0; i < 70; ++i) DrawCrack(&canvas, &random, 350, 2, 55);
  AddPatches(&canvas, &random, 1500, 2, 9, 60);
  for (int i = 0; i < 14; ++i) {
    const int x = random.Between(0, 2047), y = random.Between(0, 2047);
    Fill(&canvas, Disc{x, y, 24}, 50);
    Fill(&canvas, Disc{x, y, 20}, 85);
  }
  AddNoise(&canvas, seed, {512, 2, 14});
  AddWear(&canvas, seed, 14, 50);
  return canvas;
}

Canvas DrawPaving(std::uint64_t seed) {
  Canvas canvas(512);
  Random random(seed);
  DrawMasonry(&canvas, seed, {32, 32, 2, 125, 180, 75, true});
  AddPatches(&canvas, &random, 150, 2, 8, 50);
  AddNoise(&canvas, seed, {128, 2, 12});
  AddWear(&canvas, seed, 8, 50);
  return canvas;
}

Canvas DrawFoliage(std::uint64_t seed) {
  Canvas canvas(512, 55);
  Random random(seed);
  for (int i = 0; i < 5000; ++i) {
    const Disc leaf = {random.Between(0, 511), random.Between(0, 511), random.Between(2, 7)};
    Fill(&canvas, leaf, random.Between(25, 140));
  }
  AddNoise(&canvas, seed, {128, 2, 20});
  return canvas;
}

Canvas DrawPanel(std::uint64_t seed) {
  Random random(seed);
  const int gray = random.Between(60, 215);
  Canvas canvas(512, static_cast<std::uint8_t>(gray));
  for (int i = 0; i < 4; ++i) {
    const int x = 128 * i;
    Fill(&canvas, Rectangle{x, 0, 3, 512}, gray / 2);
    Fill(&canvas, Rectangle{x + 16, 40, 96, 150}, random.Between(20, 60));
    const Rectangle reflection = {x + 16, 40, random.Between(10, 50), 150};
    Fill(&canvas, reflection, random.Between(60, 110));
    Fill(&canvas, Rectangle{x + 90, 240, 22, 7}, random.Between(20, 240));
    if (random.Chance(50)) DrawText(&canvas, &random, {x + 14, 300, 100, 60}, 4, 255 - gray);
  }
  Fill(&canvas, Rectangle{0, 215, 512, 4}, gray / 2);
  Fill(&canvas, Rectangle{0, 430, 512, 82}, 45);
  AddPatches(&canvas, &random, 60, 2, 8, 50);
  AddNoise(&canvas, seed, {128, 4, 7});
  AddWear(&canvas, seed, 6, 40);
  return canvas;
}

Canvas DrawMural(std::uint64_t seed) {
  Canvas canvas(2048);
  Random random(seed);
  DrawMasonry(&canvas, seed, {64, 32, 4, 95, 160, 185, true});
  AddPatches(&canvas, &random, 300, 5, 30, 50);
  for (int i = 0; i < 40; ++i) {
    DrawPosterAt(&canvas, &random,
                 {random.Between(0, 2047), random.Between(0, 2047), random.Between(80, 300),
                  random.Between(100, 300)});
  }
  AddNoise(&canvas, seed, {256, 2, 15});
  AddWear(&canvas, seed, 4, 45);
  return canvas;
}

}  // namespace corvo::synthetic
