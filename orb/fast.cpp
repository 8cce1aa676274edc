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
constexpr int kBlock = 32;  // pixels scored at once
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

/// One value of each of `N` neighbouring pixels of a row.
template <std::size_t N>
using Lanes = std::array<std::uint8_t, N>;

template <std::size_t N>
Lanes<N> Min(const Lanes<N>& a, const Lanes<N>& b) {
  Lanes<N> least;
  for (std::size_t i = 0; i < N; ++i) least[i] = std::min(a[i], b[i]);
  return least;
}

template <std::size_t N>
Lanes<N> Max(const Lanes<N>& a, const Lanes<N>& b) {
  Lanes<N> greatest;
  for (std::size_t i = 0; i < N; ++i) greatest[i] = std::max(a[i], b[i]);
  return greatest;
}

/// How much a exceeds b, or 0.
template <std::size_t N>
Lanes<N> Excess(const Lanes<N>& a, const Lanes<N>& b) {
  Lanes<N> excess;
  for (std::size_t i = 0; i < N; ++i) {
    excess[i] = static_cast<std::uint8_t>(std::max(a[i], b[i]) - b[i]);
  }
  return excess;
}

template <std::size_t N>
Lanes<N> Negative(const Lanes<N>& a) {
  Lanes<N> negative;
  for (std::size_t i = 0; i < N; ++i) negative[i] = static_cast<std::uint8_t>(255 - a[i]);
  return negative;
}

template <std::size_t N>
Lanes<N> Load(const std::uint8_t* pixels) {
  Lanes<N> lanes;
  std::copy_n(pixels, N, lanes.begin());
  return lanes;
}

/// The pixels of the circles around N neighbouring pixels, from the top clockwise.
template <std::size_t N>
using Circles = std::array<Lanes<N>, kCircle>;

/// The largest, over the arcs of 9, of an arc's least pixel. Arcs come in twos that share 8 pixels,
/// from even places on; windows of 8 are built from windows of 2 and 4.
template <std::size_t N>
Lanes<N> BrightestArc(const Circles<N>& circle) {
  std::array<Lanes<N>, kHalfCircle> least2;
  std::array<Lanes<N>, kHalfCircle> least4;
  for (int k = 0; k < kHalfCircle; ++k) least2[k] = Min(circle[2 * k], circle[2 * k + 1]);
  for (int k = 0; k < kHalfCircle; ++k) least4[k] = Min(least2[k], least2[(k + 1) % kHalfCircle]);
  Lanes<N> brightest{};
  for (int k = 0; k < kHalfCircle; ++k) {
    const Lanes<N> least8 = Min(least4[k], least4[(k + 2) % kHalfCircle]);
    const Lanes<N>& before = circle[(2 * k + kCircle - 1) % kCircle];
    const Lanes<N>& after = circle[(2 * k + 8) % kCircle];
    brightest = Max(brightest, Min(least8, Max(before, after)));
  }
  return brightest;
}

/// By how much the brightest arc of 9 exceeds the centre, or the centre the darkest arc; else 0.
template <std::size_t N>
Lanes<N> ArcContrast(const std::uint8_t* pixels, const CircleOffsets& offsets) {
  const Lanes<N> centre = Load<N>(pixels);
  Circles<N> circle;
  Circles<N> negative;
  for (int k = 0; k < kCircle; ++k) {
    circle[k] = Load<N>(pixels + offsets[k]);
    negative[k] = Negative(circle[k]);
  }
  return Max(Excess(BrightestArc(circle), centre),
             Excess(BrightestArc(negative), Negative(centre)));
}

/// Whether any of N pixels may have an arc of 9 of contrast above `threshold`: such an arc holds
/// one pixel at least of every two opposite ones.
template <std::size_t N>
bool MayHaveCorner(const std::uint8_t* pixels, const CircleOffsets& offsets, int threshold) {
  const Lanes<N> centre = Load<N>(pixels);
  Lanes<N> above = centre;
  above.fill(255);
  Lanes<N> below = above;
  for (int k = 0; k < kHalfCircle; k += 2) {
    const Lanes<N> a = Load<N>(pixels + offsets[k]);
    const Lanes<N> b = Load<N>(pixels + offsets[k + kHalfCircle]);
    above = Min(above, Excess(Max(a, b), centre));
    below = Min(below, Excess(centre, Min(a, b)));
  }
  const Lanes<N> bound = Max(above, below);
  return *std::max_element(bound.begin(), bound.end()) > threshold;
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
    const std::uint8_t* pixels = image_.ptr<std::uint8_t>(y);
    const int end = scored_.br().x;
    Row(y).Clear();
    int x = scored_.x;
    for (; x + kBlock <= end; x += kBlock) ScoreBlock<kBlock>(pixels, x, Row(y));
    for (; x < end; ++x) ScoreBlock<1>(pixels, x, Row(y));
  }

  template <std::size_t N>
  void ScoreBlock(const std::uint8_t* pixels, int x, ScoreRow& row) const {
    if (!MayHaveCorner<N>(pixels + x, offsets_, threshold_)) return;
    const Lanes<N> contrast = ArcContrast<N>(pixels + x, offsets_);
    for (std::size_t i = 0; i < N; ++i) {
      if (contrast[i] <= threshold_) continue;
      const int column = x + static_cast<int>(i);
      row.scores[column] = static_cast<std::uint8_t>(contrast[i] - 1);
      row.columns.push_back(column);
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
