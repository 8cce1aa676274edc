#include "orb/kernels/line_search.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/line_search.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || !HWY_HAVE_FLOAT64
using scalar::FindNearLine;
#else
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::CappedTag<double, 8>;
using V64 = hn::Vec<D64>;

/// Of the points from `i` on, a bit for each that is near the line, up to the end of the register.
HWY_INLINE unsigned BitsNearLine(const LinePoints& points, int i, const Line& line) {
  const D64 d;
  const V64 ax = hn::Mul(hn::Set(d, line.a), hn::LoadU(d, points.x + i));
  const V64 by = hn::Mul(hn::Set(d, line.b), hn::LoadU(d, points.y + i));
  const V64 distance = hn::Add(hn::Add(ax, by), hn::Set(d, line.c));
  const V64 squared_norm = hn::Set(d, line.a * line.a + line.b * line.b);
  const V64 limit = hn::Mul(hn::LoadU(d, points.max_squared_distances + i), squared_norm);
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, hn::Le(hn::Mul(distance, distance), limit), bits);
  return bits[0];
}

int FindNearLine(const LinePoints& points, const Line& line, std::int32_t* found) {
  const int step = static_cast<int>(hn::Lanes(D64()));
  int count = 0;
  int i = 0;
  for (; i + step <= points.count; i += step) {
    for (unsigned bits = BitsNearLine(points, i, line); bits != 0; bits &= bits - 1) {
      found[count++] = i + std::countr_zero(bits);
    }
  }
  const LinePoints rest = {points.x + i, points.y + i, points.max_squared_distances + i,
                           points.count - i};
  const int end = count + scalar::FindNearLine(rest, line, found + count);
  for (; count < end; ++count) found[count] += i;
  return end;
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindNearLine);

int FindNearLine(const LinePoints& points, const Line& line, std::int32_t* found) {
  return HWY_DYNAMIC_DISPATCH(FindNearLine)(points, line, found);
}

namespace scalar {

int FindNearLine(const LinePoints& points, const Line& line, std::int32_t* found) {
  const double squared_norm = line.a * line.a + line.b * line.b;
  int count = 0;
  for (int i = 0; i < points.count; ++i) {
    const double distance = line.a * points.x[i] + line.b * points.y[i] + line.c;
    if (distance * distance <= points.max_squared_distances[i] * squared_norm) found[count++] = i;
  }
  return count;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
