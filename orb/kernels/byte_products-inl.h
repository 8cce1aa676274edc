// SPDX-License-Identifier: MIT
// Included once for every instruction set.
#if defined(CORVO_ORB_KERNELS_BYTE_PRODUCTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CORVO_ORB_KERNELS_BYTE_PRODUCTS_INL_H
#undef CORVO_ORB_KERNELS_BYTE_PRODUCTS_INL_H
#else
#define CORVO_ORB_KERNELS_BYTE_PRODUCTS_INL_H
#endif

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Element i is a[2 i] b[2 i] + a[2 i + 1] b[2 i + 1], where `a` is unsigned and `b` signed: x86's
// product of bytes, which Highway 1.0 does not have. The sums must fit 16 bits.

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSSE3
HWY_INLINE hn::Vec128<std::int16_t> SumByteProducts(hn::Vec128<std::uint8_t> a,
                                                    hn::Vec128<std::int8_t> b) {
  return hn::Vec128<std::int16_t>{_mm_maddubs_epi16(a.raw, b.raw)};
}
#if HWY_TARGET <= HWY_AVX2
HWY_INLINE hn::Vec256<std::int16_t> SumByteProducts(hn::Vec256<std::uint8_t> a,
                                                    hn::Vec256<std::int8_t> b) {
  return hn::Vec256<std::int16_t>{_mm256_maddubs_epi16(a.raw, b.raw)};
}
#endif
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE hn::Vec512<std::int16_t> SumByteProducts(hn::Vec512<std::uint8_t> a,
                                                    hn::Vec512<std::int8_t> b) {
  return hn::Vec512<std::int16_t>{_mm512_maddubs_epi16(a.raw, b.raw)};
}
#endif
#else
template <typename Unsigned, typename Signed>
HWY_INLINE auto SumByteProducts(Unsigned a, Signed b) {
  const hn::Repartition<std::int16_t, hn::DFromV<Signed> > d16;
  const auto pairs_a = hn::BitCast(d16, a);
  const auto pairs_b = hn::BitCast(d16, b);
  const auto even_a = hn::And(pairs_a, hn::Set(d16, 0xFF));
  const auto even_b = hn::ShiftRight<8>(hn::ShiftLeft<8>(pairs_b));
  const auto odd_a = hn::And(hn::ShiftRight<8>(pairs_a), hn::Set(d16, 0xFF));
  const auto odd_b = hn::ShiftRight<8>(pairs_b);
  return hn::Add(hn::Mul(even_a, even_b), hn::Mul(odd_a, odd_b));
}
#endif

}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
