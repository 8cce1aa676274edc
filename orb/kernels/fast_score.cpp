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
using CircleOffsets = std::array<std::ptrdiff_t, kCircle>;

/// Of the pixels of the circle from its center, from the top clockwise.
inline CircleOffsets MakeCircle(std::ptrdiff_t stride) {
  constexpr std::array<int, kCircle> kX = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  CircleOffsets offsets{};
  for (int k = 0; k < kCircle; ++k) offsets[k] = kX[k] - kX[(k + 4) % kCircle] * stride;
  return offsets;
}

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

/// By how much the brightest arc of 9 exceeds the center, or the center the darkest arc; else 0.
/// Arcs come in twos that share 8 pixels, from even places on; windows of 8 are built from windows
/// of 2 and 4.
HWY_INLINE Lanes ArcContrast(const std::uint8_t* pixels, const CircleOffsets& offsets) {
  const Tag d;
  const Lanes center = hn::LoadU(d, pixels);
  Lanes circle[kCircle];
  Lanes least[kHalfCircle];
  Lanes greatest[kHalfCircle];
  for (int k = 0; k < kCircle; ++k) circle[k] = hn::LoadU(d, pixels + offsets[k]);
  for (int k = 0; k < kHalfCircle; ++k) {
    least[k] = hn::Min(circle[2 * k], circle[2 * k + 1]);
    greatest[k] = hn::Max(circle[2 * k], circle[2 * k + 1]);
  }
  Lanes least4[kHalfCircle];
  Lanes greatest4[kHalfCircle];
  for (int k = 0; k < kHalfCircle; ++k) {
    least4[k] = hn::Min(least[k], least[(k + 1) % kHalfCircle]);
    greatest4[k] = hn::Max(greatest[k], greatest[(k + 1) % kHalfCircle]);
  }
  Lanes brightest = hn::Zero(d);
  Lanes darkest = hn::Set(d, 255);
  for (int k = 0; k < kHalfCircle; ++k) {
    const Lanes before = circle[(2 * k + kCircle - 1) % kCircle];
    const Lanes after = circle[(2 * k + 8) % kCircle];
    const Lanes least8 = hn::Min(least4[k], least4[(k + 2) % kHalfCircle]);
    const Lanes greatest8 = hn::Max(greatest4[k], greatest4[(k + 2) % kHalfCircle]);
    brightest = hn::Max(brightest, hn::Min(least8, hn::Max(before, after)));
    darkest = hn::Min(darkest, hn::Max(greatest8, hn::Min(before, after)));
  }
  return hn::Max(hn::SaturatedSub(brightest, center), hn::SaturatedSub(center, darkest));
}

/// Whether any of a block's pixels may have an arc of 9 of contrast above the threshold: such an
/// arc holds one pixel at least of every two opposite ones.
HWY_INLINE bool MayHaveCorner(const std::uint8_t* pixels, const CircleOffsets& circle,
                              Lanes threshold) {
  const Tag d;
  const Lanes center = hn::LoadU(d, pixels);
  Lanes above = hn::Set(d, 255);
  Lanes below = hn::Zero(d);
  for (int k = 0; k < kHalfCircle; k += 2) {
    const Lanes a = hn::LoadU(d, pixels + circle[k]);
    const Lanes b = hn::LoadU(d, pixels + circle[k + kHalfCircle]);
    above = hn::Min(above, hn::Max(a, b));
    below = hn::Max(below, hn::Min(a, b));
  }
  const Lanes bound = hn::Max(hn::SaturatedSub(above, center), hn::SaturatedSub(center, below));
  return !hn::AllFalse(d, hn::Gt(bound, threshold));
}

void ScoreFastRow(const std::uint8_t* HWY_RESTRICT row, std::ptrdiff_t stride, int width,
                  int threshold, std::uint8_t* HWY_RESTRICT scores) {
  const Tag d;
  const int step = static_cast<int>(hn::Lanes(d));
  if (width < step) return scalar::ScoreFastRow(row, stride, width, threshold, scores);
  const CircleOffsets circle = MakeCircle(stride);
  const bool is_high = threshold >= 12;  // Below, most blocks have a candidate: no use in looking.
  const Lanes threshold_lanes = hn::Set(d, static_cast<std::uint8_t>(threshold));
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    if (is_high && !MayHaveCorner(row + x, circle, threshold_lanes)) {
      hn::StoreU(hn::Zero(d), d, scores + x);
      continue;
    }
    const Lanes contrast = ArcContrast(row + x, circle);
    const auto is_corner = hn::Gt(contrast, threshold_lanes);
    const Lanes score = hn::IfThenElseZero(is_corner, hn::Sub(contrast, hn::Set(d, 1)));
    hn::StoreU(score, d, scores + x);
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
  int count = 0;
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    const int num_seen = begin - x;
    const std::uint64_t bits = MaximaBits(above, here, below, x) >> num_seen << num_seen;
    count += WriteBits(bits, x, columns + count);
  }
  return count;
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
