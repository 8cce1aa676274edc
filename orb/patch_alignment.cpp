#include "orb/patch_alignment.h"

#include <array>
#include <cmath>

namespace corvo::orb {
namespace {

constexpr int kWindowRadius = 4;
constexpr int kWindowSide = 2 * kWindowRadius + 1;
constexpr int kNumPixels = kWindowSide * kWindowSide;
constexpr int kTemplateSide = kWindowSide + 2;  // With a rim, for derivatives.

using Window = std::array<float, kNumPixels>;

/// Grey value between pixels; (x, y) from the middle, inside the patch.
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

/// Whether a square of `half_side` around (x, y), or its image under a warp, lies inside a patch.
bool Reaches(const PatchWarp& warp, float half_side) {
  constexpr float kEnd = Patch::kRadius - 0.01F;
  return half_side * (std::abs(warp.a) + std::abs(warp.b)) < kEnd &&
         half_side * (std::abs(warp.c) + std::abs(warp.d)) < kEnd;
}

void SubtractMean(Window& window) {
  float sum = 0;
  for (const float value : window) sum += value;
  const float mean = sum / kNumPixels;
  for (float& value : window) value -= mean;
}

float Dot(const Window& a, const Window& b) {
  float sum = 0;
  for (int i = 0; i < kNumPixels; ++i) sum += a[i] * b[i];
  return sum;
}

/// What is looked for: grey values and derivatives, each with mean 0.
struct Template {
  Window grey, by_x, by_y;
  float xx = 0, xy = 0, yy = 0, norm = 0;
};

Template MakeTemplate(const Patch& reference, const PatchWarp& warp) {
  std::array<float, kTemplateSide * kTemplateSide> rim;
  for (int i = 0, y = -kWindowRadius - 1; y <= kWindowRadius + 1; ++y) {
    for (int x = -kWindowRadius - 1; x <= kWindowRadius + 1; ++x, ++i) {
      const float u = static_cast<float>(x), v = static_cast<float>(y);
      rim[i] = Interpolate(reference, warp.a * u + warp.b * v, warp.c * u + warp.d * v);
    }
  }
  Template result;
  for (int i = 0, y = 0; y < kWindowSide; ++y) {
    for (int x = 0; x < kWindowSide; ++x, ++i) {
      const float* p = rim.data() + (y + 1) * kTemplateSide + x + 1;
      result.grey[i] = *p;
      result.by_x[i] = 0.5F * (p[1] - p[-1]);
      result.by_y[i] = 0.5F * (p[kTemplateSide] - p[-kTemplateSide]);
    }
  }
  SubtractMean(result.grey);
  SubtractMean(result.by_x);
  SubtractMean(result.by_y);
  result.xx = Dot(result.by_x, result.by_x);
  result.xy = Dot(result.by_x, result.by_y);
  result.yy = Dot(result.by_y, result.by_y);
  result.norm = std::sqrt(Dot(result.grey, result.grey));
  return result;
}

Window CutWindow(const Patch& target, float x, float y) {
  Window window;
  for (int i = 0, v = -kWindowRadius; v <= kWindowRadius; ++v) {
    for (int u = -kWindowRadius; u <= kWindowRadius; ++u, ++i) {
      window[i] = Interpolate(target, x + static_cast<float>(u), y + static_cast<float>(v));
    }
  }
  SubtractMean(window);
  return window;
}

}  // namespace

std::optional<PatchAlignment> AlignPatch(const Patch& reference, const Patch& target,
                                         const PatchWarp& reference_from_target) {
  constexpr int kMaxIterations = 12;
  constexpr float kMaxShift = 3;
  constexpr float kAtRest = 0.02F;
  constexpr float kMinTexture = 81;  // Of the weaker direction: one grey level a pixel.
  if (!Reaches(reference_from_target, kWindowRadius + 1)) return std::nullopt;
  const Template wanted = MakeTemplate(reference, reference_from_target);
  const float determinant = wanted.xx * wanted.yy - wanted.xy * wanted.xy;
  if (determinant < kMinTexture * (wanted.xx + wanted.yy)) return std::nullopt;
  PatchAlignment at;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Window window = CutWindow(target, at.x, at.y);
    const float fit = Dot(window, wanted.grey);
    const float norm = std::sqrt(Dot(window, window));
    at.correlation = norm > 0 ? fit / (norm * wanted.norm) : 0;
    const float gain = fit / (wanted.norm * wanted.norm);
    if (gain < 0.1F) return std::nullopt;
    const float ex = Dot(window, wanted.by_x) - gain * Dot(wanted.grey, wanted.by_x);
    const float ey = Dot(window, wanted.by_y) - gain * Dot(wanted.grey, wanted.by_y);
    const float step_x = (wanted.yy * ex - wanted.xy * ey) / (determinant * gain);
    const float step_y = (wanted.xx * ey - wanted.xy * ex) / (determinant * gain);
    at.x -= step_x;
    at.y -= step_y;
    if (!(std::abs(at.x) < kMaxShift && std::abs(at.y) < kMaxShift)) return std::nullopt;
    if (std::abs(step_x) < kAtRest && std::abs(step_y) < kAtRest) return at;
  }
  return std::nullopt;
}

}  // namespace corvo::orb
