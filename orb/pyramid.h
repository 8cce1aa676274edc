// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/resizer.h"

namespace corvo::orb {

/// One level of an image pyramid. A pixel (x, y) of the level has its center in the input image at
///
///     ((x + 0.5) * ratio_x - 0.5, (y + 0.5) * ratio_y - 0.5),
///
/// where the ratios are those of the true sizes, which are rounded to whole pixels.
struct PyramidLevel {
  cv::Mat image;       ///< 8-bit, one channel.
  double ratio_x = 1;  ///< Input width over level width.
  double ratio_y = 1;  ///< Input height over level height.

  /// Column in the input image of a column of the level.
  double InputX(double x) const { return (x + 0.5) * ratio_x - 0.5; }
  /// Row in the input image of a row of the level.
  double InputY(double y) const { return (y + 0.5) * ratio_y - 0.5; }
  /// Column in the level of a column of the input image: the inverse of InputX.
  double LevelX(double x) const { return (x + 0.5) / ratio_x - 0.5; }
  /// Row in the level of a row of the input image: the inverse of InputY.
  double LevelY(double y) const { return (y + 0.5) / ratio_y - 0.5; }
};

/// factor^level for `num_levels` levels.
std::vector<double> OctaveScales(int num_levels, double factor);

class Workers;

/// The pyramids of one image after another; keeps its buffers.
class Pyramid {
 public:
  /// Level sizes are the input's over `scales`, rounded, at least 1 px.
  explicit Pyramid(std::vector<double> scales) : scales_(std::move(scales)) {}

  /// Sets levels() to those of `image` (8-bit, one channel; level 0 shares its pixels). Each level
  /// is resized from the one before.
  void Build(const cv::Mat& image, Workers& workers);

  /// Valid until the next Build().
  const std::vector<PyramidLevel>& levels() const { return levels_; }

  /// Lets go of the input's pixels, which level 0 shares.
  void ReleaseInput() { levels_.front().image.release(); }

 private:
  /// Lays out the levels of an input of this size.
  void LayOut(cv::Size size);
  /// Resizes level `i` to the next.
  void ResizeLevel(int i, Workers& workers);

  std::vector<double> scales_;
  cv::Size input_size_;
  std::vector<PyramidLevel> levels_;
  std::vector<Resizer> resizers_;  ///< Of level i + 1.
  std::vector<Resizer::RowCache> row_caches_;
};

/// The levels of one image, as Pyramid makes them.
std::vector<PyramidLevel> BuildPyramid(const cv::Mat& image, const std::vector<double>& scales);

}  // namespace corvo::orb
