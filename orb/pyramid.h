// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/resizer.h"

namespace corvo::orb {

/// One level of an image pyramid. The center of pixel (x, y) of the level is, in the input image,
/// at
///
///     ((x + 0.5) * ratio_x - 0.5, (y + 0.5) * ratio_y - 0.5),
///
/// where the ratios are those of the actual level sizes, which are rounded to whole pixels.
struct PyramidLevel {
  cv::Mat image;       ///< 8-bit, one channel.
  double ratio_x = 1;  ///< Input width over level width.
  double ratio_y = 1;  ///< Input height over level height.

  /// Returns the column in the input image of a column of the level.
  double InputX(double x) const { return (x + 0.5) * ratio_x - 0.5; }
  /// Returns the row in the input image of a row of the level.
  double InputY(double y) const { return (y + 0.5) * ratio_y - 0.5; }
  /// Returns the column in the level of a column of the input image: the inverse of InputX().
  double LevelX(double x) const { return (x + 0.5) / ratio_x - 0.5; }
  /// Returns the row in the level of a row of the input image: the inverse of InputY().
  double LevelY(double y) const { return (y + 0.5) / ratio_y - 0.5; }
};

/// Returns factor^level for each of `num_levels` levels.
std::vector<double> OctaveScales(int num_levels, double factor);

class Workers;

/// Builds the pyramids of one image after another. Keeps its buffers; not thread-safe.
class Pyramid {
 public:
  /// Sets the level sizes to the input size divided by `scales`, rounded, at least 1 px.
  explicit Pyramid(std::vector<double> scales) : scales_(std::move(scales)) {}

  /// Sets levels() to the levels of `image` (8-bit, one channel; level 0 shares its pixels). Each
  /// level is resized from the previous one.
  void Build(const cv::Mat& image, Workers& workers);

  /// Returns the levels, which are valid until the next Build().
  const std::vector<PyramidLevel>& levels() const { return levels_; }

  /// Releases the input image, whose pixels level 0 shares.
  void ReleaseInput() { levels_.front().image.release(); }

 private:
  /// Allocates the levels for an input of this size.
  void LayOut(cv::Size size);
  /// Resizes level `i` to level `i` + 1.
  void ResizeLevel(int i, Workers& workers);

  std::vector<double> scales_;
  cv::Size input_size_;
  std::vector<PyramidLevel> levels_;
  std::vector<Resizer> resizers_;  ///< Element i makes level i + 1.
  std::vector<Resizer::RowCache> row_caches_;
};

/// Returns the levels of one image, as computed by Pyramid.
std::vector<PyramidLevel> BuildPyramid(const cv::Mat& image, const std::vector<double>& scales);

}  // namespace corvo::orb
