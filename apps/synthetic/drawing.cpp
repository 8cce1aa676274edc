// SPDX-License-Identifier: MIT
#include "apps/synthetic/drawing.h"

#include <algorithm>
#include <vector>

namespace corvo::synthetic {
namespace {

std::uint8_t Clamp(int gray) { return static_cast<std::uint8_t>(std::clamp(gray, 0, 255)); }

/// Returns 3t² - 2t³ at t = i / cell, in units of 1/256.
std::vector<int> SmoothSteps(int cell) {
  std::vector<int> steps(static_cast<std::size_t>(cell));
  const std::int64_t n = cell;
  for (std::int64_t i = 0; i < n; ++i) {
    steps[static_cast<std::size_t>(i)] =
        static_cast<int>(256 * i * i * (3 * n - 2 * i) / (n * n * n));
  }
  return steps;
}

/// One octave of value noise, added to `sum` in units of 1/128 of `amplitude`.
class Octave {
 public:
  Octave(std::uint64_t seed, int side, int cell)
      : cell_(cell), count_(side / cell), steps_(SmoothSteps(cell)) {
    for (int y = 0; y < count_; ++y) {
      for (int x = 0; x < count_; ++x) {
        lattice_.push_back(static_cast<int>(Hash(seed, x, y) & 255) - 128);
      }
    }
  }

  void AddRow(int y, int amplitude, std::vector<int>* sum) const {
    const int v = steps_[static_cast<std::size_t>(y % cell_)];
    const int row = y / cell_;
    std::size_t x = 0;
    for (int column = 0; column < count_; ++column) {
      const int left = (256 - v) * At(column, row) + v * At(column, row + 1);
      const int right = (256 - v) * At(column + 1, row) + v * At(column + 1, row + 1);
      for (const int u : steps_) {
        (*sum)[x++] += ((256 - u) * left + u * right) / 65536 * amplitude;
      }
    }
  }

 private:
  int At(int x, int y) const { return lattice_[(y % count_) * count_ + x % count_]; }

  int cell_, count_;
  std::vector<int> steps_, lattice_;
};

}  // namespace

void AddNoise(Canvas* canvas, std::uint64_t seed, const Noise& noise) {
  std::vector<Octave> octaves;
  for (int cell = noise.coarsest; cell >= noise.finest; cell /= 2) {
    octaves.emplace_back(Hash(seed, cell), canvas->side, cell);
  }
  std::vector<int> sum(static_cast<std::size_t>(canvas->side));
  for (int y = 0; y < canvas->side; ++y) {
    std::fill(sum.begin(), sum.end(), 0);
    int amplitude = 256 * noise.amplitude;
    for (const Octave& octave : octaves) {
      octave.AddRow(y, amplitude / 256, &sum);
      amplitude = amplitude * 3 / 4;
    }
    for (int x = 0; x < canvas->side; ++x) {
      std::uint8_t& texel = canvas->At(x, y);
      texel = Clamp(texel + sum[static_cast<std::size_t>(x)] / 128);
    }
  }
}

void Fill(Canvas* canvas, const Rectangle& area, int gray) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) canvas->At(x, y) = Clamp(gray);
  }
}

void Add(Canvas* canvas, const Rectangle& area, int grays) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      canvas->At(x, y) = Clamp(canvas->At(x, y) + grays);
    }
  }
}

void Fill(Canvas* canvas, const Disc& area, int gray) {
  for (int v = -area.radius; v <= area.radius; ++v) {
    for (int u = -area.radius; u <= area.radius; ++u) {
      if (u * u + v * v > area.radius * area.radius) continue;
      canvas->At(area.x + u, area.y + v) = Clamp(gray);
    }
  }
}

void DrawCrack(Canvas* canvas, Random* random, int length, int thickness, int gray) {
  int x = random->Between(0, canvas->side - 1), y = random->Between(0, canvas->side - 1);
  const int drift_x = random->Between(-1, 1), drift_y = random->Between(-1, 1);
  for (int i = 0; i < length; ++i) {
    Fill(canvas, {x, y, thickness, thickness}, gray);
    x += random->Between(-1, 1);
    y += random->Between(-1, 1);
    if (random->Chance(50)) x += drift_x;
    if (random->Chance(50)) y += drift_y;
  }
}

void DrawText(Canvas* canvas, Random* random, const Rectangle& area, int dot, int gray) {
  for (int y = area.y; y + 5 * dot <= area.y + area.height; y += 8 * dot) {
    for (int x = area.x; x + 3 * dot <= area.x + area.width; x += 4 * dot) {
      if (random->Chance(15)) continue;
      const std::uint64_t glyph = random->Next();
      for (int i = 0; i < 15; ++i) {
        if ((glyph >> i & 1) == 0) continue;
        Fill(canvas, {x + i % 3 * dot, y + i / 3 * dot, dot, dot}, gray);
      }
    }
  }
}

}  // namespace corvo::synthetic
