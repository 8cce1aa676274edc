// SPDX-License-Identifier: MIT
#include "orb/kernels/disc_search.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/disc_search.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || !HWY_HAVE_FLOAT64
using scalar::FindInDisc;
#else
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::CappedTag<double, 8>;
using V64 = hn::Vec<D64>;

/// Of the points from `i` on, a bit for each that is in the disc, up to the end of the register.
HWY_INLINE unsigned BitsInDisc(const PointGrid& grid, int i, const OctaveDisc& disc) {
  const D64 d64;
  const hn::Rebind<float, D64> d_float;
  const hn::Rebind<std::int32_t, D64> d_int;
  const V64 dx = hn::Sub(hn::PromoteTo(d64, hn::LoadU(d_float, grid.x + i)), hn::Set(d64, disc.x));
  const V64 dy = hn::Sub(hn::PromoteTo(d64, hn::LoadU(d_float, grid.y + i)), hn::Set(d64, disc.y));
  const V64 square = hn::Set(d64, disc.radius * disc.radius);
  const auto near = hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), square);
  const V64 octave = hn::PromoteTo(d64, hn::LoadU(d_int, grid.octaves + i));
  const auto in_octaves = hn::And(hn::Ge(octave, hn::Set(d64, disc.min_octave)),
                                  hn::Le(octave, hn::Set(d64, disc.max_octave)));
  std::uint8_t bits[8];
  hn::StoreMaskBits(d64, hn::And(near, in_octaves), bits);
  return bits[0];
}

int FindInDisc(const PointGrid& grid, const CellRange& cells, const OctaveDisc& disc,
               std::int32_t* HWY_RESTRICT found) {
  const int step = static_cast<int>(hn::Lanes(D64()));
  int count = 0;
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    const std::int32_t* starts = grid.cell_starts + row * grid.columns;
    const int end = starts[cells.last_column + 1];
    for (int i = starts[cells.first_column]; i < end; i += step) {
      unsigned bits = BitsInDisc(grid, i, disc);
      if (end - i < step) bits &= (1U << (end - i)) - 1;
      for (int lane = 0; lane < step; ++lane) {
        found[count] = grid.indices[i + lane];
        count += static_cast<int>(bits >> lane & 1);
      }
    }
  }
  return count;
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindInDisc);

int FindInDisc(const PointGrid& grid, const CellRange& cells, const OctaveDisc& disc,
               std::int32_t* found) {
  return HWY_DYNAMIC_DISPATCH(FindInDisc)(grid, cells, disc, found);
}

namespace scalar {

int FindInDisc(const PointGrid& grid, const CellRange& cells, const OctaveDisc& disc,
               std::int32_t* found) {
  int count = 0;
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    const std::int32_t* starts = grid.cell_starts + row * grid.columns;
    for (int i = starts[cells.first_column]; i < starts[cells.last_column + 1]; ++i) {
      const double dx = grid.x[i] - disc.x;
      const double dy = grid.y[i] - disc.y;
      if (dx * dx + dy * dy > disc.radius * disc.radius) continue;
      if (grid.octaves[i] < disc.min_octave || grid.octaves[i] > disc.max_octave) continue;
      found[count++] = grid.indices[i];
    }
  }
  return count;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
