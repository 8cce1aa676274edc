// SPDX-License-Identifier: MIT
#include "vo/tracking/cell_displacement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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
      num_cells_(CountCells(reference.pixels.cols), CountCells(reference.pixels.rows)) {
  const cv::Mat kernel_x = (cv::Mat_<float>(1, 3) << -1, 0, 1);
  const cv::Mat kernel_y = (cv::Mat_<float>(3, 1) << -1, 0, 1);
  cv::filter2D(reference_.pixels, gradient_x_, CV_16S, kernel_x);
  cv::filter2D(reference_.pixels, gradient_y_, CV_16S, kernel_y);
  for (int i = 0; i < num_cells_.area(); ++i) textures_.push_back(MeasureTexture(CellAt(i)));
}

std::vector<CellMotion> CellDisplacement::Measure(const ReducedImage& image) const {
  std::vector<CellMotion> motion;
  motion.reserve(textures_.size());
  for (int i = 0; i < num_cells_.area(); ++i) {
    motion.push_back(MeasureCell(CellAt(i), textures_[i], image));
  }
  return motion;
}

cv::Rect CellDisplacement::CellAt(int index) const {
  const cv::Rect cell(index % num_cells_.width * kCellSize, index / num_cells_.width * kCellSize,
                      kCellSize, kCellSize);
  return cell & cv::Rect(cv::Point(), reference_.pixels.size());
}

CellDisplacement::Texture CellDisplacement::MeasureTexture(const cv::Rect& cell) const {
  int x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (int row = cell.y; row < cell.y + cell.height; ++row) {
    const auto* gx = gradient_x_.ptr<std::int16_t>(row);
    const auto* gy = gradient_y_.ptr<std::int16_t>(row);
    for (int column = cell.x; column < cell.x + cell.width; ++column) {
      x += gx[column];
      y += gy[column];
      xx += gx[column] * gx[column];
      xy += gx[column] * gy[column];
      yy += gy[column] * gy[column];
    }
  }
  const double n = cell.area();
  Texture texture{(xx - x * x / n) / 4, (xy - x * y / n) / 4, (yy - y * y / n) / 4, x / n / 2,
                  y / n / 2};
  const double least = kMinTexture * n;
  // Both eigenvalues of the matrix of sums are at least `least`.
  texture.is_sufficient = texture.xx + texture.yy >= 2 * least &&
                          (texture.xx - least) * (texture.yy - least) >= texture.xy * texture.xy;
  return texture;
}

CellDisplacement::Change CellDisplacement::SumChange(const cv::Rect& cell,
                                                     const ReducedImage& image) const {
  int e = 0, ee = 0, xe = 0, ye = 0;
  for (int row = cell.y; row < cell.y + cell.height; ++row) {
    const auto* gx = gradient_x_.ptr<std::int16_t>(row);
    const auto* gy = gradient_y_.ptr<std::int16_t>(row);
    const auto* before = reference_.pixels.ptr<std::uint8_t>(row);
    const auto* after = image.pixels.ptr<std::uint8_t>(row);
    for (int column = cell.x; column < cell.x + cell.width; ++column) {
      const int change = after[column] - before[column];
      e += change;
      ee += change * change;
      xe += gx[column] * change;
      ye += gy[column] * change;
    }
  }
  return {static_cast<double>(e), static_cast<double>(ee), xe / 2.0, ye / 2.0};
}

CellMotion CellDisplacement::MeasureCell(const cv::Rect& cell, const Texture& texture,
                                         const ReducedImage& image) const {
  if (!texture.is_sufficient) return {};
  const double n = cell.area();
  const Change change = SumChange(cell, image);
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
  return {true, is_changed, static_cast<float>(dx * image.factor),
          static_cast<float>(dy * image.factor)};
}

cv::Point2f CellDisplacement::CenterOf(int cell) const {
  const cv::Rect rect = CellAt(cell);
  const cv::Point2f center(rect.x + rect.width / 2.f, rect.y + rect.height / 2.f);
  const cv::Point2f middle(reference_.pixels.cols / 2.f, reference_.pixels.rows / 2.f);
  return (center - middle) * reference_.factor;
}

}  // namespace corvo
