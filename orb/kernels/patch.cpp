// SPDX-License-Identifier: MIT
#include "orb/kernels/patch.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/patch.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::TestPatch;
#else
namespace hn = hwy::HWY_NAMESPACE;

/// Copies numbers [-kPatchRadius, kPatchRadius + 3] of a row: whole registers.
HWY_INLINE void CopyRow(const std::uint16_t* row, std::uint16_t* copy) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const hn::FixedTag<std::uint16_t, 8> d8;
  for (int i = 0; i < 32; i += static_cast<int>(hn::Lanes(d))) {
    hn::Store(hn::LoadU(d, row - kPatchRadius + i), d, copy + i);
  }
  hn::Store(hn::LoadU(d8, row - kPatchRadius + 32), d8, copy + 32);
}

void TestPatch(const std::uint16_t* center, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  alignas(64) std::uint16_t patch[(2 * kPatchRadius + 1) * kPatchStride];
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    CopyRow(center + y * stride, patch + (y + kPatchRadius) * kPatchStride);
  }
  for (int byte = 0; byte < kPatchTests / 8; ++byte) {
    const std::uint16_t* p = tests.p.data() + 8 * byte;
    const std::uint16_t* q = tests.q.data() + 8 * byte;
    unsigned bits = 0;
    for (int i = 7; i >= 0; --i) bits += bits + (patch[p[i]] < patch[q[i]] ? 1 : 0);
    bytes[byte] = static_cast<std::uint8_t>(bits);
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(TestPatch);

void TestPatch(const std::uint16_t* center, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  HWY_DYNAMIC_DISPATCH(TestPatch)(center, stride, tests, bytes);
}

namespace scalar {
namespace {

/// The number that has this PatchIndex.
int NumberAt(const std::uint16_t* center, std::ptrdiff_t stride, int index) {
  const int x = index % kPatchStride - kPatchRadius;
  const int y = index / kPatchStride - kPatchRadius;
  return center[y * stride + x];
}

}  // namespace

void TestPatch(const std::uint16_t* center, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes) {
  std::fill_n(bytes, kPatchTests / 8, std::uint8_t{0});
  for (int i = 0; i < kPatchTests; ++i) {
    const bool less = NumberAt(center, stride, tests.p[i]) < NumberAt(center, stride, tests.q[i]);
    bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | less << (i % 8));
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
