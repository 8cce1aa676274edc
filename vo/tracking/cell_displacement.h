// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo {

/// An image reduced by an integer factor to a width near 320 px, by averaging.
struct ReducedImage {
  explicit ReducedImage(const cv::Mat& image);

  cv::Mat pixels;  ///< 8-bit gray.
  int factor = 1;  ///< Pixels of the image per pixel of `pixels`, along each axis.
};

/// What became of the content of one cell of a reference image in another image.
struct CellMotion {
  bool is_textured = false;  ///< Otherwise nothing is known of the motion.
  /// The content is not that of the reference, displaced by at most about a pixel.
  bool is_changed = false;
  float dx = 0, dy = 0;  ///< Displacement, px of the image.

  float displacement() const { return std::hypot(dx, dy); }
  bool IsStill(double max_displacement) const {
    return is_textured && !is_changed && displacement() < max_displacement;
  }
};

/// Measures small displacements of the cells of an image against a reference image: one linearized
/// least-squares step per cell over the displacement and a change of brightness (Lucas and Kanade,
/// "An iterative image registration technique", 1981), on reduced images.
class CellDisplacement {
 public:
  static constexpr int kCellSize = 10;  ///< px of the reduced image.

  explicit CellDisplacement(const ReducedImage& reference);

  /// One entry per cell in row-major order. `image` has the size of the reference.
  std::vector<CellMotion> Measure(const ReducedImage& image);
  /// The entries of one row of cells.
  std::vector<CellMotion> MeasureRow(int row, const ReducedImage& image);

  const ReducedImage& reference() const { return reference_; }
  cv::Size num_cells() const { return num_cells_; }
  /// The center of a cell relative to that of the image, px of the image.
  cv::Point2f CenterOf(int cell) const;

 private:
  struct Texture {
    double xx = 0, xy = 0, yy = 0;  ///< Sums over the cell of products of the centered gradients.
    double mean_x = 0, mean_y = 0;  ///< Means of the gradients.
    double area = 0;                ///< px
    bool is_sufficient = false;
  };

  struct Change {
    double e = 0, ee = 0;   ///< Sums of the change of gray level and of its square.
    double xe = 0, ye = 0;  ///< Sums of its products with the gradients.
  };

  /// Computes the gradients and the textures of a row of cells unless they are known already: an
  /// image that differs from the reference is often recognized by a few rows.
  const std::vector<Texture>& TexturesOf(int row);
  void ComputeGradients(const cv::Range& rows);
  std::vector<Texture> MeasureTextures(int row) const;
  std::vector<Change> SumChanges(int row, const ReducedImage& image) const;
  CellMotion MeasureCell(const Texture& texture, const Change& change) const;
  cv::Rect CellAt(int index) const;

  ReducedImage reference_;
  cv::Mat gradient_x_, gradient_y_;  // 16-bit; twice the derivative.
  cv::Size num_cells_;
  std::vector<std::vector<Texture>> textures_;  // By row of cells; empty until needed.
};

}  // namespace corvo
