#include "orb/fast.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace corvo::orb {
namespace {

constexpr int kRadius = 3;
constexpr int kCircle = 16;
constexpr int kHalfCircle = kCircle / 2;
constexpr std::array<std::array<int, 2>, kCircle> kCircleXY = {{{0, -3},
                                                                {1, -3},
                                                                {2, -2},
                                                                {3, -1},
                                                                {3, 0},
                                                                {3, 1},
                                                                {2, 2},
                                                                {1, 3},
                                                                {0, 3},
                                                                {-1, 3},
                                                                {-2, 2},
                                                                {-3, 1},
                                                                {-3, 0},
                                                                {-3, -1},
                                                                {-2, -2},
                                                                {-1, -3}}};

using CircleOffsets = std::array<std::ptrdiff_t, kCircle>;

CircleOffsets MakeOffsets(std::ptrdiff_t stride) {
  CircleOffsets offsets{};
  for (int k = 0; k < kCircle; ++k) offsets[k] = kCircleXY[k][1] * stride + kCircleXY[k][0];
  return offsets;
}

/// An upper bound of the contrast of any arc of 9 around each of `count` pixels: such an arc holds
/// one pixel at least of every two opposite ones.
void BoundContrast(const std::uint8_t* centre, const CircleOffsets& offsets, int count,
                   std::uint8_t* __restrict bound) {
  for (int x = 0; x < count; ++x) {
    std::uint8_t brightest = 255;
    std::uint8_t darkest = 0;
    for (int k = 0; k < kHalfCircle; k += 2) {
      const std::uint8_t a = centre[x + offsets[k]];
      const std::uint8_t b = centre[x + offsets[k + kHalfCircle]];
      brightest = std::min(brightest, std::max(a, b));
      darkest = std::max(darkest, std::min(a, b));
    }
    const std::uint8_t c = centre[x];
    const auto above = static_cast<std::uint8_t>(std::max(brightest, c) - c);
    const auto below = static_cast<std::uint8_t>(c - std::min(darkest, c));
    bound[x] = std::max(above, below);
  }
}

/// The largest contrast of an arc of 9 (its least difference from the centre), brighter or darker;
/// negative if there is none. Windows of 9 are built from windows of 2, 4 and 8.
int ArcContrast(const std::uint8_t* centre, const CircleOffsets& offsets) {
  std::array<std::int16_t, 2 * kCircle> low{};
  for (int k = 0; k < kCircle; ++k) {
    low[k] = static_cast<std::int16_t>(centre[offsets[k]] - *centre);
    low[k + kCircle] = low[k];
  }
  const std::array<std::int16_t, 2 * kCircle> differences = low;
  std::array<std::int16_t, 2 * kCircle> high = low;
  for (const int step : {1, 2, 4}) {
    for (int k = 0; k + step < 2 * kCircle; ++k) {
      low[k] = std::min(low[k], low[k + step]);
      high[k] = std::max(high[k], high[k + step]);
    }
  }
  int contrast = -255;
  for (int k = 0; k < kCircle; ++k) {
    const int brighter = std::min(low[k], differences[k + 8]);
    const int darker = -std::max(high[k], differences[k + 8]);
    contrast = std::max({contrast, brighter, darker});
  }
  return contrast;
}

/// Scores of one image row: zero where there is no corner.
struct ScoreRow {
  std::vector<std::uint8_t> scores;
  std::vector<int> columns;  ///< Of the corners, ascending.

  void Clear() {
    for (const int x : columns) scores[x] = 0;
    columns.clear();
  }
};

/// Detects and suppresses in one pass over the rows, three rows of scores at a time.
class FastDetector {
 public:
  FastDetector(const cv::Mat& image, int threshold, const cv::Rect& region)
      : image_(image),
        threshold_(threshold),
        region_(region),
        scored_(Scored(image, region)),
        offsets_(MakeOffsets(static_cast<std::ptrdiff_t>(image.step))) {
    for (ScoreRow& row : rows_) row.scores.resize(image.cols);
    bounds_.resize((scored_.width + 7) / 8 * 8);
  }

  std::vector<Corner> Detect() {
    for (int y = scored_.y; y < scored_.br().y; ++y) {
      Score(y);
      if (y > scored_.y) AppendMaxima(y - 1);
    }
    Row(scored_.br().y).Clear();
    AppendMaxima(scored_.br().y - 1);
    return std::move(corners_);
  }

 private:
  /// The region and the neighbours of its pixels, less the image's edge.
  static cv::Rect Scored(const cv::Mat& image, const cv::Rect& region) {
    const cv::Rect grown(region.x - 1, region.y - 1, region.width + 2, region.height + 2);
    return grown & cv::Rect(kRadius, kRadius, std::max(0, image.cols - 2 * kRadius),
                            std::max(0, image.rows - 2 * kRadius));
  }

  ScoreRow& Row(int y) { return rows_[y % 3]; }

  void Score(int y) {
    const std::uint8_t* pixels = image_.ptr<std::uint8_t>(y) + scored_.x;
    ScoreRow& row = Row(y);
    row.Clear();
    BoundContrast(pixels, offsets_, scored_.width, bounds_.data());
    for (int i = 0; i < scored_.width; ++i) {
      if (bounds_[i] <= threshold_) continue;
      const int contrast = ArcContrast(pixels + i, offsets_);
      if (contrast <= threshold_) continue;
      row.scores[scored_.x + i] = static_cast<std::uint8_t>(contrast - 1);
      row.columns.push_back(scored_.x + i);
    }
  }

  void AppendMaxima(int y) {
    if (y < region_.y || y >= region_.br().y) return;
    const std::uint8_t* above = Row(y + 2).scores.data();  // y - 1 modulo 3
    const std::uint8_t* here = Row(y).scores.data();
    const std::uint8_t* below = Row(y + 1).scores.data();
    for (const int x : Row(y).columns) {
      if (x < region_.x || x >= region_.br().x) continue;
      const std::uint8_t rival = std::max({above[x - 1], above[x], above[x + 1], here[x - 1],
                                           here[x + 1], below[x - 1], below[x], below[x + 1]});
      if (here[x] > rival) corners_.push_back({x, y, here[x]});
    }
  }

  const cv::Mat& image_;
  int threshold_;
  cv::Rect region_;
  cv::Rect scored_;
  CircleOffsets offsets_;
  std::array<ScoreRow, 3> rows_;
  std::vector<std::uint8_t> bounds_;
  std::vector<Corner> corners_;
};

}  // namespace

std::vector<Corner> DetectFast(const cv::Mat& image, int threshold, const cv::Rect& region) {
  const cv::Rect inside = region & cv::Rect(0, 0, image.cols, image.rows);
  if (inside.empty() || image.cols <= 2 * kRadius || image.rows <= 2 * kRadius) return {};
  return FastDetector(image, threshold, inside).Detect();
}

std::vector<Corner> DetectFast(const cv::Mat& image, int threshold) {
  return DetectFast(image, threshold, cv::Rect(0, 0, image.cols, image.rows));
}

}  // namespace corvo::orb
