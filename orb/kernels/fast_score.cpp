// SPDX-License-Identifier: MIT
#include "orb/kernels/fast_score.h"

#include <algorithm>
#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/fast_score.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#ifndef CORVO_ORB_KERNELS_FAST_CIRCLE
#define CORVO_ORB_KERNELS_FAST_CIRCLE
namespace corvo::orb::kernels {

constexpr int kCircle = 16;
constexpr int kHalfCircle = kCircle / 2;

/// Columns of the pixels of the circle from its center, from the top clockwise.
constexpr std::array<int, kCircle> kCircleX = {0, 1,  2,  3,  3,  3,  2,  1,
                                               0, -1, -2, -3, -3, -3, -2, -1};

/// Rows of the pixels of the circle from its center.
constexpr std::array<int, kCircle> kCircleY = [] {
  std::array<int, kCircle> y{};
  for (int k = 0; k < kCircle; ++k) y[k] = -kCircleX[(k + 4) % kCircle];
  return y;
}();

}  // namespace corvo::orb::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FindRowMaxima;
using scalar::ScoreFastRow;
#else
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<std::uint8_t>;
using Lanes = hn::Vec<Tag>;

/// The first pixels of the rows that the circle covers.
using Rows = std::array<const std::uint8_t*, 2 * kCircleRadius + 1>;

/// Pixel k of the circles around the pixels from column `x` on.
HWY_INLINE Lanes CirclePixels(const Rows& rows, int x, int k) {
  return hn::LoadU(Tag(), rows[kCircleRadius + kCircleY[k]] + x + kCircleX[k]);
}

/// What the two pixels of every diameter of the circle tell about arcs of 9, which hold both of one
/// diameter, and one at least of every other.
struct Diameters {
  Lanes least_bright;   ///< The least, over the diameters, of the brighter pixels.
  Lanes greatest_dark;  ///< The greatest, over the diameters, of the darker pixels.
};

HWY_INLINE Diameters CompareOpposites(const Rows& rows, int x) {
  const Lanes top = CirclePixels(rows, x, 0);
  const Lanes bottom = CirclePixels(rows, x, kHalfCircle);
  Diameters diameters{hn::Max(top, bottom), hn::Min(top, bottom)};
  for (int k = 1; k < kHalfCircle; ++k) {
    const Lanes a = CirclePixels(rows, x, k);
    const Lanes b = CirclePixels(rows, x, k + kHalfCircle);
    diameters.least_bright = hn::Min(diameters.least_bright, hn::Max(a, b));
    diameters.greatest_dark = hn::Max(diameters.greatest_dark, hn::Min(a, b));
  }
  return diameters;
}

/// No arc of 9 has more contrast to its center.
HWY_INLINE Lanes ContrastBound(const Diameters& diameters, Lanes center) {
  const Lanes above = hn::Min(diameters.least_bright, diameters.greatest_dark);
  const Lanes below = hn::Max(diameters.least_bright, diameters.greatest_dark);
  return hn::Max(hn::SaturatedSub(above, center), hn::SaturatedSub(center, below));
}

/// The least pixel of the brightest arc of 9, all pixels being inverted where `flip` is 255. Arcs
/// come in fours that share 6 pixels, and in twos of these that share 8.
HWY_INLINE Lanes BrightestArc(const Rows& rows, int x, Lanes flip) {
  const Tag d;
  Lanes circle[kCircle];
  Lanes least2[kHalfCircle];  // Of pixels 2 k + 1 and 2 k + 2.
  for (int k = 0; k < kCircle; ++k) circle[k] = hn::Xor(CirclePixels(rows, x, k), flip);
  for (int k = 0; k < kHalfCircle; ++k) {
    least2[k] = hn::Min(circle[2 * k + 1], circle[(2 * k + 2) % kCircle]);
  }
  Lanes brightest = hn::Zero(d);
  for (int k = 0; k < kHalfCircle; k += 2) {  // The four arcs that begin at 2 k to 2 k + 3.
    const Lanes early = hn::Min(least2[k], hn::Max(circle[2 * k], circle[(2 * k + 9) % kCircle]));
    const Lanes late = hn::Min(least2[(k + 4) % kHalfCircle],
                               hn::Max(circle[2 * k + 2], circle[(2 * k + 11) % kCircle]));
    const Lanes shared = hn::Min(
        least2[k + 1], hn::Min(least2[(k + 2) % kHalfCircle], least2[(k + 3) % kHalfCircle]));
    brightest = hn::Max(brightest, hn::Min(shared, hn::Max(early, late)));
  }
  return brightest;
}

/// Scores of a register of pixels. A bright arc of contrast holds a diameter whose darker pixel
/// exceeds the center, and a dark one forbids it: so one kind of arc remains to be looked for.
HWY_INLINE Lanes Scores(const Rows& rows, int x, Lanes threshold) {
  const Tag d;
  const Lanes zero = hn::Zero(d);
  const Lanes center = hn::LoadU(d, rows[kCircleRadius] + x);
  const Diameters diameters = CompareOpposites(rows, x);
  const Lanes excess_bound = hn::SaturatedSub(ContrastBound(diameters, center), threshold);
  if (hn::AllTrue(d, hn::Eq(excess_bound, zero))) return zero;
  const Lanes darker = hn::Min(diameters.greatest_dark, center);
  const Lanes flip = hn::VecFromMask(d, hn::Eq(diameters.greatest_dark, darker));
  const Lanes brightest = BrightestArc(rows, x, flip);
  const Lanes contrast = hn::SaturatedSub(brightest, hn::Xor(center, flip));
  const auto is_none = hn::Eq(hn::SaturatedSub(contrast, threshold), zero);
  return hn::IfThenZeroElse(is_none, hn::Sub(contrast, hn::Set(d, 1)));
}

void ScoreFastRow(const std::uint8_t* HWY_RESTRICT row, std::ptrdiff_t stride, int width,
                  int threshold, std::uint8_t* HWY_RESTRICT scores) {
  const Tag d;
  const int step = static_cast<int>(hn::Lanes(d));
  if (width < step) return scalar::ScoreFastRow(row, stride, width, threshold, scores);
  Rows rows;
  for (int y = -kCircleRadius; y <= kCircleRadius; ++y) rows[y + kCircleRadius] = row + y * stride;
  const Lanes threshold_lanes = hn::Set(d, static_cast<std::uint8_t>(threshold));
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    hn::StoreU(Scores(rows, x, threshold_lanes), d, scores + x);
  }
}

/// Bit x: whether the score at x exceeds those of its 8 neighbors.
HWY_INLINE std::uint64_t MaximaBits(const std::uint8_t* above, const std::uint8_t* here,
                                    const std::uint8_t* below, int x) {
  const Tag d;
  const Lanes score = hn::LoadU(d, here + x);
  Lanes rival = hn::Max(hn::LoadU(d, here + x - 1), hn::LoadU(d, here + x + 1));
  for (int dx = -1; dx <= 1; ++dx) {
    rival = hn::Max(rival, hn::LoadU(d, above + x + dx));
    rival = hn::Max(rival, hn::LoadU(d, below + x + dx));
  }
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, hn::Gt(score, rival), reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Writes x + i for every bit i that is set, ascending; returns how many are. The first kMaximaRoom
/// are written whether set or not: to guess their number wrong would cost more.
HWY_INLINE int WriteBits(std::uint64_t bits, int x, std::uint16_t* columns) {
  constexpr std::uint64_t kLast = std::uint64_t{1} << 63;  // Where no bit is left.
  const int count = std::popcount(bits);
  for (int i = 0; i < kMaximaRoom; ++i, bits &= bits - 1) {
    columns[i] = static_cast<std::uint16_t>(x + std::countr_zero(bits | kLast));
  }
  for (int i = kMaximaRoom; i < count; ++i, bits &= bits - 1) {
    columns[i] = static_cast<std::uint16_t>(x + std::countr_zero(bits));
  }
  return count;
}

int FindRowMaxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  int width, std::uint16_t* columns) {
  const int step = static_cast<int>(hn::Lanes(Tag()));
  if (width < step) return scalar::FindRowMaxima(above, here, below, width, columns);
  const int last = width - step;
  int count = 0;
  int x = 0;
  for (; x < last; x += step) {
    count += WriteBits(MaximaBits(above, here, below, x), x, columns + count);
  }
  const int num_seen = x - last;
  const std::uint64_t bits = MaximaBits(above, here, below, last) >> num_seen << num_seen;
  return count + WriteBits(bits, last, columns + count);
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindRowMaxima);
HWY_EXPORT(ScoreFastRow);

void ScoreFastRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, int threshold,
                  std::uint8_t* scores) {
  HWY_DYNAMIC_DISPATCH(ScoreFastRow)(row, stride, width, threshold, scores);
}

int FindRowMaxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  int width, std::uint16_t* columns) {
  return HWY_DYNAMIC_DISPATCH(FindRowMaxima)(above, here, below, width, columns);
}

namespace scalar {
namespace {

using CircleOffsets = std::array<std::ptrdiff_t, kCircle>;

CircleOffsets MakeCircle(std::ptrdiff_t stride) {
  CircleOffsets offsets{};
  for (int k = 0; k < kCircle; ++k) offsets[k] = kCircleX[k] + kCircleY[k] * stride;
  return offsets;
}

/// The least, over the 9 pixels of an arc, by which they exceed the center, or the center them.
int ArcContrast(const std::uint8_t* pixel, const CircleOffsets& circle, int first) {
  int above = 255;
  int below = 255;
  for (int k = first; k < first + 9; ++k) {
    const int difference = pixel[circle[k % kCircle]] - *pixel;
    above = std::min(above, difference);
    below = std::min(below, -difference);
  }
  return std::max(above, below);
}

int BestContrast(const std::uint8_t* pixel, const CircleOffsets& circle) {
  int best = 0;
  for (int k = 0; k < kCircle; ++k) best = std::max(best, ArcContrast(pixel, circle, k));
  return best;
}

/// Of two opposite pixels of the circle, every arc of 9 holds one at least.
bool MayBeCorner(const std::uint8_t* pixel, const CircleOffsets& circle, int threshold) {
  bool above = true;
  bool below = true;
  for (int k = 0; k < kHalfCircle && (above || below); ++k) {
    const auto [darker, brighter] = std::minmax(pixel[circle[k]], pixel[circle[k + kHalfCircle]]);
    above = above && brighter > *pixel + threshold;
    below = below && darker < *pixel - threshold;
  }
  return above || below;
}

}  // namespace

void ScoreFastRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, int threshold,
                  std::uint8_t* scores) {
  const CircleOffsets circle = MakeCircle(stride);
  for (int x = 0; x < width; ++x) {
    scores[x] = 0;
    if (!MayBeCorner(row + x, circle, threshold)) continue;
    const int contrast = BestContrast(row + x, circle);
    if (contrast > threshold) scores[x] = static_cast<std::uint8_t>(contrast - 1);
  }
}

int FindRowMaxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  int width, std::uint16_t* columns) {
  int count = 0;
  for (int x = 0; x < width; ++x) {
    const int rival = std::max({above[x - 1], above[x], above[x + 1], here[x - 1], here[x + 1],
                                below[x - 1], below[x], below[x + 1]});
    if (here[x] > rival) columns[count++] = static_cast<std::uint16_t>(x);
  }
  return count;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
