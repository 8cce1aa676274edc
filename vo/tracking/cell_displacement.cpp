// SPDX-License-Identifier: MIT
#include "vo/tracking/cell_displacement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace corvo {
namespace {

constexpr int kReducedWidth = 320;
/// Least mean square of the gradient along the direction in which a cell has least texture, gray
/// levels per pixel squared: below, noise hides the motion.
constexpr double kMinTexture = 4;
/// Largest root mean square of the residual as a share of that of the gradient, per pixel of the
/// reduced image: content that has changed altogether leaves about 1 or more.
constexpr double kMaxResidual = 0.5;
/// A residual below this is noise of the sensor or of a codec, gray levels.
constexpr double kMaxNoise = 3;

/// Returns the number of cells along an axis. The last one may be incomplete, by up to a half.
int CountCells(int size) {
  return std::max(1, static_cast<int>(std::lround(size / double{CellDisplacement::kCellSize})));
}

/// Sums over the rows of a row of cells, column by column: these loops the compiler vectorizes.
class ColumnSums {
 public:
  explicit ColumnSums(int width) : sums_(width) {}

  void Add(const std::int16_t* row) {
    for (std::size_t x = 0; x < sums_.size(); ++x) sums_[x] += row[x];
  }
  void AddProduct(const std::int16_t* a, const std::int16_t* b) {
    for (std::size_t x = 0; x < sums_.size(); ++x) sums_[x] += a[x] * b[x];
  }
  /// Returns the sum over the columns of a cell.
  double Over(const cv::Rect& cell) const {
    const auto first = sums_.begin() + cell.x;
    return std::accumulate(first, first + cell.width, 0);
  }

 private:
  std::vector<int> sums_;
};

}  // namespace

ReducedImage::ReducedImage(const cv::Mat& image)
    : factor(std::max(1, static_cast<int>(std::lround(image.cols / double{kReducedWidth})))) {
  if (factor == 1) {
    pixels = image.clone();
    return;
  }
  const cv::Size size(std::max(1, image.cols / factor), std::max(1, image.rows / factor));
  const cv::Rect whole_blocks(0, 0, std::min(image.cols, size.width * factor),
                              std::min(image.rows, size.height * factor));
  cv::resize(image(whole_blocks), pixels, size, 0, 0, cv::INTER_AREA);
}

CellDisplacement::CellDisplacement(const ReducedImage& reference)
    : reference_(reference),
      gradient_x_(reference.pixels.size(), CV_16S),
      gradient_y_(reference.pixels.size(), CV_16S),
      num_cells_(CountCells(reference.pixels.cols), CountCells(reference.pixels.rows)),
      textures_(num_cells_.height) {}

std::vector<CellMotion> CellDisplacement::Measure(const ReducedImage& image) {
  std::vector<CellMotion> motion;
  motion.reserve(num_cells_.area());
  for (int row = 0; row < num_cells_.height; ++row) {
    const std::vector<CellMotion> of_row = MeasureRow(row, image);
    motion.insert(motion.end(), of_row.begin(), of_row.end());
  }
  return motion;
}

std::vector<CellMotion> CellDisplacement::MeasureRow(int row, const ReducedImage& image) {
  const std::vector<Texture>& textures = TexturesOf(row);
  const std::vector<Change> changes = SumChanges(row, image);
  std::vector<CellMotion> motion;
  motion.reserve(textures.size());
  for (std::size_t i = 0; i < textures.size(); ++i) {
    motion.push_back(MeasureCell(textures[i], changes[i]));
  }
  return motion;
}

cv::Rect CellDisplacement::CellAt(int index) const {
  const cv::Rect cell(index % num_cells_.width * kCellSize, index / num_cells_.width * kCellSize,
                      kCellSize, kCellSize);
  return cell & cv::Rect(cv::Point(), reference_.pixels.size());
}

const std::vector<CellDisplacement::Texture>& CellDisplacement::TexturesOf(int row) {
  if (textures_[row].empty()) {
    const cv::Rect first = CellAt(row * num_cells_.width);
    ComputeGradients({first.y, first.y + first.height});
    textures_[row] = MeasureTextures(row);
  }
  return textures_[row];
}

void CellDisplacement::ComputeGradients(const cv::Range& rows) {
  const int width = reference_.pixels.cols, last_row = reference_.pixels.rows - 1;
  for (int row = rows.start; row < rows.end; ++row) {
    const auto* pixels = reference_.pixels.ptr<std::uint8_t>(row);
    // The image continues as if mirrored at its border: the derivative across it is zero.
    const auto* above = reference_.pixels.ptr<std::uint8_t>(row == 0 ? last_row > 0 : row - 1);
    const auto* below =
        reference_.pixels.ptr<std::uint8_t>(row == last_row ? std::max(0, row - 1) : row + 1);
    auto* gx = gradient_x_.ptr<std::int16_t>(row);
    auto* gy = gradient_y_.ptr<std::int16_t>(row);
    gx[0] = gx[width - 1] = 0;
    for (int x = 1; x < width - 1; ++x) {
      gx[x] = static_cast<std::int16_t>(pixels[x + 1] - pixels[x - 1]);
    }
    for (int x = 0; x < width; ++x) gy[x] = static_cast<std::int16_t>(below[x] - above[x]);
  }
}

std::vector<CellDisplacement::Texture> CellDisplacement::MeasureTextures(int row) const {
  const int width = reference_.pixels.cols;
  ColumnSums x(width), y(width), xx(width), xy(width), yy(width);
  const cv::Rect first = CellAt(row * num_cells_.width);
  for (int line = first.y; line < first.y + first.height; ++line) {
    const auto* gx = gradient_x_.ptr<std::int16_t>(line);
    const auto* gy = gradient_y_.ptr<std::int16_t>(line);
    x.Add(gx);
    y.Add(gy);
    xx.AddProduct(gx, gx);
    xy.AddProduct(gx, gy);
    yy.AddProduct(gy, gy);
  }
  std::vector<Texture> textures;
  for (int column = 0; column < num_cells_.width; ++column) {
    const cv::Rect cell = CellAt(row * num_cells_.width + column);
    const double n = cell.area(), sx = x.Over(cell), sy = y.Over(cell);
    Texture texture{(xx.Over(cell) - sx * sx / n) / 4,
                    (xy.Over(cell) - sx * sy / n) / 4,
                    (yy.Over(cell) - sy * sy / n) / 4,
                    sx / n / 2,
                    sy / n / 2,
                    n};
    const double least = kMinTexture * n;
    // Both eigenvalues of the matrix of sums are at least `least`.
    texture.is_sufficient = texture.xx + texture.yy >= 2 * least &&
                            (texture.xx - least) * (texture.yy - least) >= texture.xy * texture.xy;
    textures.push_back(texture);
  }
  return textures;
}

std::vector<CellDisplacement::Change> CellDisplacement::SumChanges(
    int row, const ReducedImage& image) const {
  const int width = reference_.pixels.cols;
  ColumnSums e(width), ee(width), xe(width), ye(width);
  std::vector<std::int16_t> change(width);
  const cv::Rect first = CellAt(row * num_cells_.width);
  for (int line = first.y; line < first.y + first.height; ++line) {
    const auto* before = reference_.pixels.ptr<std::uint8_t>(line);
    const auto* after = image.pixels.ptr<std::uint8_t>(line);
    for (int x = 0; x < width; ++x) change[x] = static_cast<std::int16_t>(after[x] - before[x]);
    e.Add(change.data());
    ee.AddProduct(change.data(), change.data());
    xe.AddProduct(gradient_x_.ptr<std::int16_t>(line), change.data());
    ye.AddProduct(gradient_y_.ptr<std::int16_t>(line), change.data());
  }
  std::vector<Change> changes;
  for (int column = 0; column < num_cells_.width; ++column) {
    const cv::Rect cell = CellAt(row * num_cells_.width + column);
    changes.push_back({e.Over(cell), ee.Over(cell), xe.Over(cell) / 2, ye.Over(cell) / 2});
  }
  return changes;
}

CellMotion CellDisplacement::MeasureCell(const Texture& texture, const Change& change) const {
  if (!texture.is_sufficient) return {};
  const double n = texture.area;
  const double determinant = texture.xx * texture.yy - texture.xy * texture.xy;
  const double xe = change.xe - texture.mean_x * change.e;
  const double ye = change.ye - texture.mean_y * change.e;
  // To first order, content displaced by d changes the image by minus the gradient times d.
  const double dx = -(texture.yy * xe - texture.xy * ye) / determinant;
  const double dy = -(texture.xx * ye - texture.xy * xe) / determinant;
  const double residual = (change.ee - change.e * change.e / n + dx * xe + dy * ye) / n;
  const double gradient = (texture.xx + texture.yy) / 2 / n;
  const double max_residual =
      std::max(kMaxNoise * kMaxNoise, kMaxResidual * kMaxResidual * gradient);
  const bool is_changed = residual > max_residual || std::hypot(dx, dy) > 1;
  const int factor = reference_.factor;
  return {true, is_changed, static_cast<float>(dx * factor), static_cast<float>(dy * factor)};
}

cv::Point2f CellDisplacement::CenterOf(int cell) const {
  const cv::Rect rect = CellAt(cell);
  const cv::Point2f center(rect.x + rect.width / 2.f, rect.y + rect.height / 2.f);
  const cv::Point2f middle(reference_.pixels.cols / 2.f, reference_.pixels.rows / 2.f);
  return (center - middle) * reference_.factor;
}

}  // namespace corvo
