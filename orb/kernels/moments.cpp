// SPDX-License-Identifier: MIT
#include "orb/kernels/moments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/moments.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#include "orb/kernels/byte_products-inl.h"

#ifndef CORVO_ORB_KERNELS_MOMENT_WEIGHTS
#define CORVO_ORB_KERNELS_MOMENT_WEIGHTS
namespace corvo::orb::kernels {

constexpr int kRows = 2 * kMomentRadius + 1;
constexpr int kRowLength = 2 * kMomentRadius + 2;  // columns [-16, 15]

/// dx and dy of the pixels of the disc; 0 outside, and in a row below it.
struct MomentWeights {
  alignas(64) std::int8_t x[kRows + 1][kRowLength];
  alignas(64) std::int8_t y[kRows + 1][kRowLength];
};

inline constexpr MomentWeights kMomentWeights = [] {
  MomentWeights weights{};
  for (int dy = -kMomentRadius; dy <= kMomentRadius; ++dy) {
    const int half_width = kDiscHalfWidths[dy < 0 ? -dy : dy];
    for (int dx = -half_width; dx <= half_width; ++dx) {
      weights.x[dy + kMomentRadius][dx + kMomentRadius + 1] = static_cast<std::int8_t>(dx);
      weights.y[dy + kMomentRadius][dx + kMomentRadius + 1] = static_cast<std::int8_t>(dy);
    }
  }
  return weights;
}();

}  // namespace corvo::orb::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::SumDiscMoments;
#else
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX3_DL

/// Products of bytes summed by fours (VNNI, which the processor has if it has this target, but
/// which Highway does not switch on), two rows at once.
__attribute__((target(HWY_TARGET_STR ",avx512vnni"))) DiscMoments SumDiscMoments(
    const std::uint8_t* center, std::ptrdiff_t stride) {
  const hn::FixedTag<std::uint8_t, 2 * kRowLength> d8;
  const hn::FixedTag<std::int8_t, 2 * kRowLength> d8_signed;
  const hn::FixedTag<std::int32_t, kRowLength / 2> d32;
  auto x = hn::Zero(d32);
  auto y = hn::Zero(d32);
  for (int row = 0; row < kRows; row += 2) {
    const std::uint8_t* pixels = center + (row - kMomentRadius) * stride - kMomentRadius - 1;
    const hn::Half<decltype(d8)> half;
    const auto gray = hn::Combine(d8, hn::LoadU(half, pixels + stride), hn::LoadU(half, pixels));
    const auto weights_x = hn::Load(d8_signed, kMomentWeights.x[row]);
    const auto weights_y = hn::Load(d8_signed, kMomentWeights.y[row]);
    x.raw = _mm512_dpbusd_epi32(x.raw, gray.raw, weights_x.raw);
    y.raw = _mm512_dpbusd_epi32(y.raw, gray.raw, weights_y.raw);
  }
  return {hn::GetLane(hn::SumOfLanes(d32, x)), hn::GetLane(hn::SumOfLanes(d32, y))};
}

#else

/// Sums in 16 bits have room for four products of pairs: 4 * 255 * (15 + 15) at most.
DiscMoments SumDiscMoments(const std::uint8_t* center, std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint8_t, kRowLength> d8;
  constexpr int kRowsAtOnce = 4 * static_cast<int>(hn::MaxLanes(d8)) / kRowLength;
  const hn::RebindToSigned<decltype(d8)> d8_signed;
  const hn::RepartitionToWide<decltype(d8_signed)> d16;
  const hn::RepartitionToWide<decltype(d16)> d32;
  auto x = hn::Zero(d32);
  auto y = hn::Zero(d32);
  auto x_rest = hn::Zero(d32);  // Highway may divide a sum in two.
  auto y_rest = hn::Zero(d32);
  for (int first = 0; first < kRows; first += kRowsAtOnce) {
    auto x16 = hn::Zero(d16);
    auto y16 = hn::Zero(d16);
    for (int row = first; row < first + kRowsAtOnce; ++row) {
      const std::uint8_t* pixels = center + (row - kMomentRadius) * stride - kMomentRadius - 1;
      for (int i = 0; i < kRowLength; i += static_cast<int>(hn::Lanes(d8))) {
        const auto gray = hn::LoadU(d8, pixels + i);
        const auto weights_x = hn::Load(d8_signed, kMomentWeights.x[row] + i);
        const auto weights_y = hn::Load(d8_signed, kMomentWeights.y[row] + i);
        x16 = hn::Add(x16, SumByteProducts(gray, weights_x));
        y16 = hn::Add(y16, SumByteProducts(gray, weights_y));
      }
    }
    x = hn::ReorderWidenMulAccumulate(d32, x16, hn::Set(d16, 1), x, x_rest);
    y = hn::ReorderWidenMulAccumulate(d32, y16, hn::Set(d16, 1), y, y_rest);
  }
  return {hn::GetLane(hn::SumOfLanes(d32, hn::Add(x, x_rest))),
          hn::GetLane(hn::SumOfLanes(d32, hn::Add(y, y_rest)))};
}

#endif
#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(SumDiscMoments);

DiscMoments SumDiscMoments(const std::uint8_t* center, std::ptrdiff_t stride) {
  return HWY_DYNAMIC_DISPATCH(SumDiscMoments)(center, stride);
}

namespace scalar {

DiscMoments SumDiscMoments(const std::uint8_t* center, std::ptrdiff_t stride) {
  DiscMoments moments;
  for (int dy = -kMomentRadius; dy <= kMomentRadius; ++dy) {
    const std::uint8_t* row = center + dy * stride;
    const int half_width = kDiscHalfWidths[dy < 0 ? -dy : dy];
    int sum = 0;
    for (int dx = -half_width; dx <= half_width; ++dx) {
      sum += row[dx];
      moments.x += dx * row[dx];
    }
    moments.y += dy * sum;
  }
  return moments;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
