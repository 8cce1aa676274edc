// SPDX-License-Identifier: MIT
#include "orb/kernels/resize.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/resize.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#include "orb/kernels/byte_products-inl.h"

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

/// As many groups as the tag has room for, from group g on. Pixels are made signed by subtracting
/// 2^7, which comes back as 2^7 times the sum of two weights.
template <typename D>
HWY_INLINE void InterpolateGroups(D d8, const std::uint8_t* source, const TapGroups& groups, int g,
                                  std::int16_t* targets) {
  const hn::RebindToSigned<D> d8_signed;
  const hn::Repartition<std::int16_t, D> d16;
  const auto pixels = LoadSources(d8, source, groups.bases + g);
  const auto taps = hn::LoadU(d8, groups.taps + g * kTapReach);
  const auto weights = hn::LoadU(d8, groups.weights + g * kTapReach);
  const auto taken = hn::Xor(hn::TableLookupBytes(pixels, taps), hn::Set(d8, 0x80));
  const auto sums = SumByteProducts(weights, hn::BitCast(d8_signed, taken));
  hn::StoreU(hn::Add(sums, hn::Set(d16, 1 << (2 * kWeightBits))), d16, targets + g * kTapsPerGroup);
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

using Tag16 = hn::ScalableTag<std::int16_t>;

/// Two rows to blend, and the nearer of them to the result.
struct RowPair {
  const std::int16_t* a;
  const std::int16_t* b;
  const std::int16_t* nearer;
};

/// `weights` are those of b, in units of 2^-16, from the nearer row on.
HWY_INLINE void BlendRegister(const RowPair& rows, hn::Vec<Tag16> weights, int x,
                              std::uint8_t* HWY_RESTRICT blended) {
  const Tag16 d16;
  const hn::Rebind<std::uint8_t, Tag16> d8;
  const auto difference = hn::Sub(hn::LoadU(d16, rows.b + x), hn::LoadU(d16, rows.a + x));
  const auto half = hn::Set(d16, 1 << (kWeightBits - 1));
  const auto raised = hn::Add(hn::LoadU(d16, rows.nearer + x), half);
  const auto sum = hn::Add(raised, hn::MulHigh(difference, weights));
  hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<kWeightBits>(sum)), d8, blended + x);
}

void BlendRows(const std::int16_t* HWY_RESTRICT a, const std::int16_t* HWY_RESTRICT b, int weight,
               int width, std::uint8_t* HWY_RESTRICT blended) {
  const int step = static_cast<int>(hn::Lanes(Tag16()));
  if (width < step) return scalar::BlendRows(a, b, weight, width, blended);
  const bool is_b_nearer = weight >= 1 << (kWeightBits - 1);
  const int from_nearer = is_b_nearer ? weight - (1 << kWeightBits) : weight;
  const auto weights = hn::Set(Tag16(), static_cast<std::int16_t>(from_nearer * (1 << 9)));
  const RowPair rows{a, b, is_b_nearer ? b : a};
  const int last = width - step;
  for (int x = 0; x < last; x += step) BlendRegister(rows, weights, x, blended);
  BlendRegister(rows, weights, last, blended);
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
      const std::uint8_t* taps = groups.taps + g * kTapReach + 2 * i;
      const std::uint8_t* weights = groups.weights + g * kTapReach + 2 * i;
      const std::uint8_t* pixels = source + groups.bases[g];
      targets[g * kTapsPerGroup + i] =
          static_cast<std::int16_t>(weights[0] * pixels[taps[0]] + weights[1] * pixels[taps[1]]);
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
