// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

/// Numbers that are read, but do not count, behind the last of each array of a PointGrid.
inline constexpr int kGridPadding = 8;

/// Points sorted by the cells of a grid: point i is at (x[i], y[i]), and cell c holds points
/// cell_starts[c] to cell_starts[c + 1] - 1.
struct PointGrid {
  const float* x;
  const float* y;
  const std::int32_t* octaves;
  const std::int32_t* indices;
  const std::int32_t* cell_starts;
  int columns;
};

/// A rectangle of cells, bounds included.
struct CellRange {
  int first_column;
  int last_column;
  int first_row;
  int last_row;
};

/// Points at most `radius` from (x, y) with an octave in [min_octave, max_octave].
struct OctaveDisc {
  double x;
  double y;
  double radius;
  int min_octave;
  int max_octave;
};

/// Writes to `found` the indices of the points in `disc` among those in `cells`, cell by cell, and
/// returns how many they are. `found` has room for as many as the cells hold, and kGridPadding.
int FindInDisc(const PointGrid& grid, const CellRange& cells, const OctaveDisc& disc,
               std::int32_t* found);

namespace scalar {
int FindInDisc(const PointGrid& grid, const CellRange& cells, const OctaveDisc& disc,
               std::int32_t* found);
}  // namespace scalar

}  // namespace corvo::orb::kernels
