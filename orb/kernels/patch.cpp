#include "orb/kernels/patch.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/patch.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#ifndef CORVO_ORB_KERNELS_PATCH_SIZES
#define CORVO_ORB_KERNELS_PATCH_SIZES
namespace corvo::orb::kernels {

constexpr int kWindowRadius = 2;
constexpr int kSide = 2 * kPatchRadius + 1;
constexpr int kNumColumns = kSide + 2 * kWindowRadius;  // of pixels
constexpr int kColumnStride = 48;

/// Sums over 5 pixels of each column, and over 5x5 windows.
struct PatchSums {
  alignas(64) std::uint16_t columns[kSide][kColumnStride];
  alignas(64) std::uint16_t windows[kSide * kPatchStride];
};

}  // namespace corvo::orb::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::TestPatch;
#else
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::uint16_t, 32>;
constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));

/// `corner` is the first pixel of the first window.
HWY_INLINE void SumColumns(const std::uint8_t* corner, std::ptrdiff_t stride, PatchSums& sums) {
  const Tag d16;
  const hn::Rebind<std::uint8_t, Tag> d8;
  for (int begin = 0; begin < kNumColumns; begin += kStep) {
    const int x = std::min(begin, kNumColumns - kStep);
    const std::uint8_t* entering = corner + x;
    auto sum = hn::Zero(d16);
    for (int i = 0; i < 2 * kWindowRadius; ++i, entering += stride) {
      sum = hn::Add(sum, hn::PromoteTo(d16, hn::LoadU(d8, entering)));
    }
    const std::uint8_t* leaving = corner + x;
    for (int y = 0; y < kSide; ++y, entering += stride, leaving += stride) {
      sum = hn::Add(sum, hn::PromoteTo(d16, hn::LoadU(d8, entering)));
      hn::StoreU(sum, d16, sums.columns[y] + x);
      sum = hn::Sub(sum, hn::PromoteTo(d16, hn::LoadU(d8, leaving)));
    }
  }
}

HWY_INLINE void SumWindows(PatchSums& sums) {
  const Tag d16;
  for (int y = 0; y < kSide; ++y) {
    for (int begin = 0; begin < kSide; begin += kStep) {
      const int x = std::min(begin, kSide - kStep);
      const std::uint16_t* columns = sums.columns[y] + x;
      auto sum = hn::LoadU(d16, columns);
      for (int i = 1; i <= 2 * kWindowRadius; ++i) sum = hn::Add(sum, hn::LoadU(d16, columns + i));
      hn::StoreU(sum, d16, sums.windows + y * kPatchStride + x);
    }
  }
}

void TestPatch(const std::uint8_t* centre, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  PatchSums sums;
  SumColumns(centre - (kPatchRadius + kWindowRadius) * (stride + 1), stride, sums);
  SumWindows(sums);
  for (int byte = 0; byte < kPatchTests / 8; ++byte) {
    const std::uint16_t* p = tests.p.data() + 8 * byte;
    const std::uint16_t* q = tests.q.data() + 8 * byte;
    unsigned bits = 0;
    for (int i = 7; i >= 0; --i) bits += bits + (sums.windows[p[i]] < sums.windows[q[i]] ? 1 : 0);
    bytes[byte] = static_cast<std::uint8_t>(bits);
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(TestPatch);

void TestPatch(const std::uint8_t* centre, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  HWY_DYNAMIC_DISPATCH(TestPatch)(centre, stride, tests, bytes);
}

namespace scalar {
namespace {

/// The sum over the window whose centre has this PatchIndex.
int SumWindow(const std::uint8_t* centre, std::ptrdiff_t stride, int index) {
  const int x = index % kPatchStride - kPatchRadius;
  const int y = index / kPatchStride - kPatchRadius;
  int sum = 0;
  for (int dy = -kWindowRadius; dy <= kWindowRadius; ++dy) {
    for (int dx = -kWindowRadius; dx <= kWindowRadius; ++dx) {
      sum += centre[(y + dy) * stride + x + dx];
    }
  }
  return sum;
}

}  // namespace

void TestPatch(const std::uint8_t* centre, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  std::fill_n(bytes, kPatchTests / 8, std::uint8_t{0});
  for (int i = 0; i < kPatchTests; ++i) {
    const bool darker =
        SumWindow(centre, stride, tests.p[i]) < SumWindow(centre, stride, tests.q[i]);
    bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | darker << (i % 8));
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
