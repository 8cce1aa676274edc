// SPDX-License-Identifier: MIT
#include "orb/resizer.h"

#include <algorithm>

namespace corvo::orb {
namespace {

constexpr int kUnit = 1 << kernels::kWeightBits;

}  // namespace

/// Returns the tap of target pixel `i`, at source position ((2i + 1) source - target) / (2 target).
Resizer::Tap Resizer::TapAt(int i, int source, int target) {
  const std::int64_t denominator = 2 * std::int64_t{target};
  const std::int64_t numerator = std::clamp((2 * std::int64_t{i} + 1) * source - target,
                                            std::int64_t{0}, denominator * (source - 1));
  const auto index = static_cast<int>(numerator / denominator);
  const std::int64_t rest = numerator % denominator;
  const auto weight = static_cast<int>((rest * kUnit + target) / denominator);
  return {index, std::min(index + 1, source - 1), weight};
}

/// Returns the taps along one axis. The second half mirrors the first, so that rounding has no
/// preferred direction.
std::vector<Resizer::Tap> Resizer::MakeTaps(int source, int target) {
  std::vector<Tap> taps(target);
  for (int i = 0; i < target; ++i) {
    const int mirrored = target - 1 - i;
    if (i <= mirrored) {
      taps[i] = TapAt(i, source, target);
    } else {
      const Tap& twin = taps[mirrored];
      taps[i] = {source - 1 - twin.next, source - 1 - twin.index, kUnit - twin.weight};
    }
  }
  for (Tap& tap : taps) {
    if (tap.weight == kUnit) tap = {tap.next, tap.next, 0};
  }
  return taps;
}

Resizer::ColumnTaps Resizer::GroupTaps(std::vector<Tap> taps, int source) {
  ColumnTaps groups;
  groups.are_near = source >= kernels::kTapReach;
  while (taps.size() % kernels::kTapsPerGroup != 0) taps.push_back(taps.back());
  int base = 0;
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const Tap& tap = taps[i];
    if (i % kernels::kTapsPerGroup == 0) {
      base = std::min(tap.index, std::max(0, source - kernels::kTapReach));
      groups.bases.push_back(base);
    }
    groups.are_near = groups.are_near && tap.next - base < kernels::kTapReach;
    groups.taps.push_back(static_cast<std::uint8_t>(tap.index - base));
    groups.taps.push_back(static_cast<std::uint8_t>(tap.next - base));
    groups.weights.push_back(static_cast<std::uint8_t>(kUnit - tap.weight));
    groups.weights.push_back(static_cast<std::uint8_t>(tap.weight));
  }
  return groups;
}

Resizer::Resizer(cv::Size from, cv::Size to)
    : from_(from),
      to_(to),
      row_taps_(MakeTaps(from.height, to.height)),
      column_taps_(GroupTaps(MakeTaps(from.width, to.width), from.width)) {}

const std::int16_t* Resizer::InterpolatedRow(const cv::Mat& image, int y, RowCache& cache) const {
  const int slot = y % 2;
  std::int16_t* row = cache.rows[slot].data();
  if (cache.held[slot] == y) return row;
  cache.held[slot] = y;
  const auto& [taps, weights, bases, are_near] = column_taps_;
  const kernels::TapGroups groups{static_cast<int>(bases.size()), taps.data(), weights.data(),
                                  bases.data()};
  const auto interpolate = are_near ? kernels::InterpolateRow : kernels::scalar::InterpolateRow;
  interpolate(image.ptr(y), groups, row);
  return row;
}

void Resizer::ResizeRows(const cv::Mat& image, int begin, int end, RowCache& cache,
                         cv::Mat& resized) const {
  for (auto& row : cache.rows) row.resize(to_.width + kernels::kTapsPerGroup);
  cache.held = {-1, -1};
  for (int y = begin; y < end; ++y) {
    const Tap& tap = row_taps_[y];
    const std::int16_t* upper = InterpolatedRow(image, tap.index, cache);
    const std::int16_t* lower = InterpolatedRow(image, tap.next, cache);
    kernels::BlendRows(upper, lower, tap.weight, to_.width, resized.ptr(y));
  }
}

cv::Mat Resize(const cv::Mat& image, cv::Size size) {
  cv::Mat resized(size, CV_8UC1);
  Resizer::RowCache cache;
  Resizer(image.size(), size).ResizeRows(image, 0, size.height, cache, resized);
  return resized;
}

}  // namespace corvo::orb
