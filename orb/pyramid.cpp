#include "orb/pyramid.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "orb/rounding.h"

namespace corvo::orb {
namespace {

constexpr int kWeightBits = 7;
constexpr int kUnit = 1 << kWeightBits;

/// Value = ((kUnit - weight) * source[index] + weight * source[next]) / kUnit.
struct Tap {
  int index = 0;
  int next = 0;
  int weight = 0;
};

/// Tap of target pixel `i`: the source position ((2i + 1) source - target) / (2 target).
Tap TapAt(int i, int source, int target) {
  const std::int64_t denominator = 2 * std::int64_t{target};
  const std::int64_t numerator = std::clamp((2 * std::int64_t{i} + 1) * source - target,
                                            std::int64_t{0}, denominator * (source - 1));
  const auto index = static_cast<int>(numerator / denominator);
  const std::int64_t rest = numerator % denominator;
  const auto weight = static_cast<int>((rest * kUnit + target) / denominator);
  return {index, std::min(index + 1, source - 1), weight};
}

/// The second half mirrors the first, so that rounded weights have no preferred direction.
std::vector<Tap> MakeTaps(int source, int target) {
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
  return taps;
}

void InterpolateRow(const std::uint8_t* source, const std::vector<Tap>& taps, std::int16_t* out) {
  for (std::size_t x = 0; x < taps.size(); ++x) {
    const Tap& tap = taps[x];
    out[x] = static_cast<std::int16_t>((kUnit - tap.weight) * source[tap.index] +
                                       tap.weight * source[tap.next]);
  }
}

void BlendRows(const std::int16_t* __restrict a, const std::int16_t* __restrict b, int weight,
               int width, std::uint8_t* __restrict out) {
  constexpr int kHalf = 1 << (2 * kWeightBits - 1);
  for (int x = 0; x < width; ++x) {
    const int sum = (kUnit - weight) * a[x] + weight * b[x];
    out[x] = static_cast<std::uint8_t>((sum + kHalf) >> (2 * kWeightBits));
  }
}

/// The two horizontally interpolated source rows last used.
class RowCache {
 public:
  RowCache(const cv::Mat& image, std::vector<Tap> taps) : image_(image), taps_(std::move(taps)) {
    for (auto& row : rows_) row.resize(taps_.size());
  }

  const std::int16_t* Row(int y) {
    const int slot = y % 2;
    if (held_[slot] != y) {
      InterpolateRow(image_.ptr<std::uint8_t>(y), taps_, rows_[slot].data());
      held_[slot] = y;
    }
    return rows_[slot].data();
  }

 private:
  const cv::Mat& image_;
  std::vector<Tap> taps_;
  std::vector<std::int16_t> rows_[2];
  int held_[2] = {-1, -1};
};

int LevelLength(int input_length, double scale) {
  return std::max(1, RoundHalfUp(input_length / scale));
}

}  // namespace

std::vector<double> OctaveScales(int num_levels, double factor) {
  std::vector<double> scales(num_levels, 1.0);
  for (int level = 1; level < num_levels; ++level) scales[level] = scales[level - 1] * factor;
  return scales;
}

cv::Mat Resize(const cv::Mat& image, cv::Size size) {
  cv::Mat resized(size, CV_8UC1);
  const std::vector<Tap> row_taps = MakeTaps(image.rows, size.height);
  RowCache cache(image, MakeTaps(image.cols, size.width));
  for (int y = 0; y < size.height; ++y) {
    const Tap& tap = row_taps[y];
    const std::int16_t* upper = cache.Row(tap.index);
    const std::int16_t* lower = cache.Row(tap.next);
    BlendRows(upper, lower, tap.weight, size.width, resized.ptr<std::uint8_t>(y));
  }
  return resized;
}

std::vector<PyramidLevel> BuildPyramid(const cv::Mat& image, const std::vector<double>& scales) {
  std::vector<PyramidLevel> levels;
  levels.reserve(scales.size());
  for (const double scale : scales) {
    const cv::Size size(LevelLength(image.cols, scale), LevelLength(image.rows, scale));
    const bool first = levels.empty();
    levels.push_back({first ? image : Resize(levels.back().image, size),
                      static_cast<double>(image.cols) / size.width,
                      static_cast<double>(image.rows) / size.height});
  }
  return levels;
}

}  // namespace corvo::orb
