#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kPatchRadius = 18;  ///< Of the windows' centres about the keypoint, px.
inline constexpr int kPatchStride = 40;  ///< Of the sums' rows, of which 37 entries are used.
inline constexpr int kPatchTests = 256;

/// Where the sum at (dx, dy) from the keypoint stands in the patch.
constexpr std::uint16_t PatchIndex(int dx, int dy) {
  return static_cast<std::uint16_t>((dy + kPatchRadius) * kPatchStride + dx + kPatchRadius);
}

/// Binary tests by PatchIndex: bit i % 8 of byte i / 8 is 1 iff the sum at p[i] is less than that
/// at q[i].
struct PatchTests {
  std::array<std::uint16_t, kPatchTests> p;
  std::array<std::uint16_t, kPatchTests> q;
};

/// Outcomes of the tests on the sums over the 5x5 windows about a pixel. `centre` points at it;
/// rows are `stride` bytes apart, and there are kPatchRadius + 2 pixels on all sides. `bytes` is
/// room for 32.
void TestPatch(const std::uint8_t* centre, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes);

namespace scalar {
void TestPatch(const std::uint8_t* centre, std::ptrdiff_t stride, const PatchTests& tests,
               std::uint8_t* bytes);
}  // namespace scalar

}  // namespace corvo::orb::kernels
