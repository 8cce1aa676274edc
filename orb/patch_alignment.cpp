// SPDX-License-Identifier: MIT
#include "orb/patch_alignment.h"

#include <array>
#include <cmath>

#include "orb/kernels/window_fit.h"

namespace corvo::orb {
namespace {

using kernels::kFitPixels;
using kernels::kFitSide;

constexpr int kWindowRadius = kFitSide / 2;  // The window spans -4 to 3 from the center.
constexpr int kTemplateSide = kFitSide + 2;  // Includes a rim of one pixel for derivatives.

/// Returns the bilinear gray value at (x, y) from the center, inside the patch.
float Interpolate(const Patch& patch, float x, float y) {
  const float column = x + Patch::kRadius, row = y + Patch::kRadius;
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const float right_share = column - static_cast<float>(left);
  const float lower_share = row - static_cast<float>(top);
  const std::uint8_t* p = patch.pixels.data() + top * Patch::kSide + left;
  const float upper = p[0] + right_share * (p[1] - p[0]);
  const float lower = p[Patch::kSide] + right_share * (p[Patch::kSide + 1] - p[Patch::kSide]);
  return upper + lower_share * (lower - upper);
}

/// Returns whether the image under `warp` of the square of half-side `half_side` around the center
/// lies inside a patch.
bool Reaches(const PatchWarp& warp, float half_side) {
  constexpr float kEnd = Patch::kRadius - 0.01F;
  return half_side * (std::abs(warp.a) + std::abs(warp.b)) < kEnd &&
         half_side * (std::abs(warp.c) + std::abs(warp.d)) < kEnd;
}

void SubtractMean(float* values) {
  float sum = 0;
  for (int i = 0; i < kFitPixels; ++i) sum += values[i];
  for (int i = 0; i < kFitPixels; ++i) values[i] -= sum / kFitPixels;
}

float Dot(const float* a, const float* b) {
  float sum = 0;
  for (int i = 0; i < kFitPixels; ++i) sum += a[i] * b[i];
  return sum;
}

/// The template: gray values and derivatives, each with mean 0, and their products.
struct Template {
  kernels::FitTemplate window;
  float xx = 0, xy = 0, yy = 0;
  float gray_x = 0, gray_y = 0, gray_gray = 0;
};

/// Returns the warped reference, with a rim of one pixel.
std::array<float, kTemplateSide * kTemplateSide> WarpReference(const Patch& reference,
                                                               const PatchWarp& warp) {
  std::array<float, kTemplateSide * kTemplateSide> warped;
  for (int i = 0, y = -kWindowRadius - 1; y <= kWindowRadius; ++y) {
    for (int x = -kWindowRadius - 1; x <= kWindowRadius; ++x, ++i) {
      const float u = static_cast<float>(x), v = static_cast<float>(y);
      warped[i] = Interpolate(reference, warp.a * u + warp.b * v, warp.c * u + warp.d * v);
    }
  }
  return warped;
}

Template MakeTemplate(const Patch& reference, const PatchWarp& warp) {
  const auto warped = WarpReference(reference, warp);
  Template result;
  kernels::FitTemplate& window = result.window;
  for (int i = 0; i < kFitPixels; ++i) {
    const float* p = warped.data() + (i / kFitSide + 1) * kTemplateSide + i % kFitSide + 1;
    window.gray[i] = *p;
    window.by_x[i] = 0.5F * (p[1] - p[-1]);
    window.by_y[i] = 0.5F * (p[kTemplateSide] - p[-kTemplateSide]);
  }
  for (float* values : {window.gray, window.by_x, window.by_y}) SubtractMean(values);
  result.xx = Dot(window.by_x, window.by_x);
  result.xy = Dot(window.by_x, window.by_y);
  result.yy = Dot(window.by_y, window.by_y);
  result.gray_x = Dot(window.gray, window.by_x);
  result.gray_y = Dot(window.gray, window.by_y);
  result.gray_gray = Dot(window.gray, window.gray);
  return result;
}

/// Returns the place in the target of the window centered at (x, y) from its center.
kernels::WindowPlace PlaceAt(const Patch& target, float x, float y) {
  const float column = x + (Patch::kRadius - kWindowRadius);
  const float row = y + (Patch::kRadius - kWindowRadius);
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  return {target.pixels.data() + top * Patch::kSide + left, Patch::kSide,
          column - static_cast<float>(left), row - static_cast<float>(top)};
}

float Correlation(const kernels::WindowFit& fit, float gray_gray) {
  const float squares = fit.squares - fit.sum * fit.sum / kFitPixels;
  return squares > 0 ? fit.with_gray / std::sqrt(squares * gray_gray) : 0;
}

}  // namespace

std::optional<PatchAlignment> AlignPatch(const Patch& reference, const Patch& target,
                                         const PatchWarp& reference_from_target) {
  constexpr int kMaxIterations = 12;
  constexpr float kMaxShift = 3;
  constexpr float kAtRest = 0.02F;
  constexpr float kMinGain = 0.1F;
  constexpr float kMinTexture = kFitPixels;  // One gray level per pixel in the weaker direction.
  if (!Reaches(reference_from_target, kWindowRadius + 1)) return std::nullopt;
  const Template wanted = MakeTemplate(reference, reference_from_target);
  const float determinant = wanted.xx * wanted.yy - wanted.xy * wanted.xy;
  if (determinant < kMinTexture * (wanted.xx + wanted.yy)) return std::nullopt;
  PatchAlignment at;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const kernels::WindowFit fit = kernels::FitWindow(PlaceAt(target, at.x, at.y), wanted.window);
    const float gain = fit.with_gray / wanted.gray_gray;
    if (!(gain > kMinGain)) return std::nullopt;
    const float error_x = fit.with_x / gain - wanted.gray_x;
    const float error_y = fit.with_y / gain - wanted.gray_y;
    const float step_x = (wanted.yy * error_x - wanted.xy * error_y) / determinant;
    const float step_y = (wanted.xx * error_y - wanted.xy * error_x) / determinant;
    at.x -= step_x;
    at.y -= step_y;
    at.correlation = Correlation(fit, wanted.gray_gray);
    if (!(std::abs(at.x) < kMaxShift && std::abs(at.y) < kMaxShift)) return std::nullopt;
    if (std::abs(step_x) < kAtRest && std::abs(step_y) < kAtRest) return at;
  }
  return std::nullopt;
}

}  // namespace corvo::orb
