// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kPatchRadius = 18;  ///< A patch is of 37 x 37 numbers.
inline constexpr int kPatchStride = 64;  ///< Of the copy that is tested.
inline constexpr int kPatchTests = 256;

/// Where the number at (dx, dy) from the patch's center stands in the copy.
constexpr std::uint16_t PatchIndex(int dx, int dy) {
  return static_cast<std::uint16_t>((dy + kPatchRadius) * kPatchStride + dx + kPatchRadius);
}

/// Binary tests by PatchIndex: bit i % 8 of byte i / 8 is 1 iff the number at p[i] is less than
/// that at q[i].
struct PatchTests {
  std::array<std::uint16_t, kPatchTests> p;
  std::array<std::uint16_t, kPatchTests> q;
};

/// Outcomes of the tests on the patch around `center`, whose rows are `stride` numbers apart; those
/// of the patch go on for 3 numbers at least. `bytes` is room for 32.
void TestPatch(const std::uint16_t* center, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes);

namespace scalar {
void TestPatch(const std::uint16_t* center, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes);
}  // namespace scalar

}  // namespace corvo::orb::kernels
