// SPDX-License-Identifier: MIT
#include "orb/kernels/window_fit.h"

#include <gtest/gtest.h>

#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::orb::kernels {
namespace {

constexpr int kWindowStride = 17;

FitTemplate RandomTemplate(unsigned seed) {
  const auto bytes = test::RandomBytes(3 * kFitPixels, seed);
  FitTemplate wanted;
  for (int i = 0; i < kFitPixels; ++i) {
    wanted.gray[i] = static_cast<float>(bytes[3 * i]) - 100.25F;
    wanted.by_x[i] = 0.5F * static_cast<float>(bytes[3 * i + 1]) - 60.1F;
    wanted.by_y[i] = 0.5F * static_cast<float>(bytes[3 * i + 2]) - 59.3F;
  }
  return wanted;
}

TEST(FitWindowTest, MatchesTheScalarVersion) {
  test::ForEveryInstructionSet([] {
    for (unsigned seed = 0; seed < 100; ++seed) {
      const auto pixels = test::RandomBytes(kWindowStride * kWindowStride, seed);
      const float share = static_cast<float>(seed) / 100;
      const WindowPlace place = {pixels.data() + seed % 5, kWindowStride, share, 0.99F - share};
      const FitTemplate wanted = RandomTemplate(seed);
      EXPECT_EQ(FitWindow(place, wanted), scalar::FitWindow(place, wanted));
    }
  });
}

TEST(FitWindowTest, SumsEqualAHandComputedExample) {
  std::vector<std::uint8_t> pixels(kWindowStride * kWindowStride);
  for (int i = 0; i < kWindowStride * kWindowStride; ++i) {
    pixels[i] = static_cast<std::uint8_t>(128 + 2 * (i % kWindowStride) + 4 * (i / kWindowStride));
  }
  FitTemplate wanted{};
  wanted.gray[0] = 3;               // Column 0, row 0.
  wanted.by_x[kFitSide - 1] = 5;    // Column 7, row 0.
  wanted.by_y[kFitPixels - 1] = 7;  // Column 7, row 7.
  const WindowFit fit = scalar::FitWindow({pixels.data(), kWindowStride, 0.5F, 0.25F}, wanted);
  EXPECT_FLOAT_EQ(fit.with_gray, 3 * (1 + 1));
  EXPECT_FLOAT_EQ(fit.with_x, 5 * (1 + 1 + 14));
  EXPECT_FLOAT_EQ(fit.with_y, 7 * (1 + 1 + 14 + 28));
  EXPECT_FLOAT_EQ(fit.sum, kFitPixels * (2 + 7 + 14));
}

}  // namespace
}  // namespace corvo::orb::kernels
