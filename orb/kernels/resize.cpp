// SPDX-License-Identifier: MIT
#include "orb/kernels/resize.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/resize.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::BlendRows;
using scalar::InterpolateRow;
#else
namespace hn = hwy::HWY_NAMESPACE;

/// The source pixels of groups g, g + 1, ... one above the other.
template <typename D>
HWY_INLINE hn::Vec<D> LoadSources(D d, const std::uint8_t* source, const std::int32_t* bases) {
  if constexpr (hn::MaxLanes(D()) == kTapReach) {
    return hn::LoadU(d, source + *bases);
  } else {
    const hn::Half<D> half;
    const int num_half = static_cast<int>(hn::MaxLanes(half)) / kTapReach;
    return hn::Combine(d, LoadSources(half, source, bases + num_half),
                       LoadSources(half, source, bases));
  }
}

/// As many groups as the tag has room for, from group g on.
template <typename D>
HWY_INLINE void InterpolateGroups(D d8, const std::uint8_t* source, const TapGroups& groups, int g,
                                  std::int16_t* targets) {
  const hn::Repartition<std::int16_t, D> d16;
  const auto pixels = LoadSources(d8, source, groups.bases + g);
  const auto first_taps = hn::LoadU(d8, groups.first + g * kTapReach);
  const auto second_taps = hn::LoadU(d8, groups.second + g * kTapReach);
  const auto weights = hn::LoadU(d16, groups.weights + g * kTapsPerGroup);
  const auto first = hn::BitCast(d16, hn::TableLookupBytesOr0(pixels, first_taps));
  const auto second = hn::BitCast(d16, hn::TableLookupBytesOr0(pixels, second_taps));
  const auto step = hn::Mul(hn::Sub(second, first), weights);
  const auto values = hn::Add(hn::ShiftLeft<kWeightBits>(first), step);
  hn::StoreU(values, d16, targets + g * kTapsPerGroup);
}

void InterpolateRow(const std::uint8_t* HWY_RESTRICT source, const TapGroups& row_groups,
                    std::int16_t* HWY_RESTRICT targets) {
  const hn::CappedTag<std::uint8_t, 4 * kTapReach> several;
  const hn::FixedTag<std::uint8_t, kTapReach> one;
  constexpr int kSeveral = static_cast<int>(hn::MaxLanes(several)) / kTapReach;
  const TapGroups groups = row_groups;  // What is written cannot change the copy.
  int g = 0;
  for (; g + kSeveral <= groups.count; g += kSeveral) {
    InterpolateGroups(several, source, groups, g, targets);
  }
  for (; g < groups.count; ++g) InterpolateGroups(one, source, groups, g, targets);
}

/// (weight * d) >> 7, rounded down.
template <typename Lanes>
HWY_INLINE Lanes Scale(Lanes difference, Lanes weight) {
  const hn::DFromV<Lanes> d;
  const Lanes high = hn::MulHigh(difference, hn::ShiftLeft<8>(weight));  // (weight * d) >> 8
  const Lanes last =
      hn::And(hn::ShiftRight<kWeightBits>(hn::Mul(difference, weight)), hn::Set(d, 1));
  return hn::Add(hn::Add(high, high), last);
}

void BlendRows(const std::int16_t* HWY_RESTRICT a, const std::int16_t* HWY_RESTRICT b, int weight,
               int width, std::uint8_t* HWY_RESTRICT blended) {
  const hn::ScalableTag<std::int16_t> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  const int step = static_cast<int>(hn::Lanes(d16));
  if (width < step) return scalar::BlendRows(a, b, weight, width, blended);
  const auto weights = hn::Set(d16, static_cast<std::int16_t>(weight));
  const auto half = hn::Set(d16, 1 << (kWeightBits - 1));
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    const auto upper = hn::LoadU(d16, a + x);
    const auto change = Scale(hn::Sub(hn::LoadU(d16, b + x), upper), weights);
    const auto rounded = hn::ShiftRight<kWeightBits>(hn::Add(hn::Add(upper, half), change));
    hn::StoreU(hn::DemoteTo(d8, rounded), d8, blended + x);
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(BlendRows);
HWY_EXPORT(InterpolateRow);

void InterpolateRow(const std::uint8_t* source, const TapGroups& groups, std::int16_t* targets) {
  HWY_DYNAMIC_DISPATCH(InterpolateRow)(source, groups, targets);
}

void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended) {
  HWY_DYNAMIC_DISPATCH(BlendRows)(a, b, weight, width, blended);
}

namespace scalar {

constexpr int kUnit = 1 << kWeightBits;

void InterpolateRow(const std::uint8_t* source, const TapGroups& groups, std::int16_t* targets) {
  for (int g = 0; g < groups.count; ++g) {
    for (int i = 0; i < kTapsPerGroup; ++i) {
      const int first = source[groups.bases[g] + groups.first[g * kTapReach + 2 * i]];
      const int second = source[groups.bases[g] + groups.second[g * kTapReach + 2 * i]];
      const int weight = groups.weights[g * kTapsPerGroup + i];
      targets[g * kTapsPerGroup + i] =
          static_cast<std::int16_t>((kUnit - weight) * first + weight * second);
    }
  }
}

void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended) {
  constexpr int kHalf = kUnit * kUnit / 2;
  for (int x = 0; x < width; ++x) {
    const int sum = (kUnit - weight) * a[x] + weight * b[x];
    blended[x] = static_cast<std::uint8_t>((sum + kHalf) >> (2 * kWeightBits));
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
