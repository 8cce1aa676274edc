#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// One level of an image pyramid. A pixel (x, y) of the level has its centre in the input image at
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

/// Bilinear interpolation of an 8-bit image at the pixel centres of `size`, with weights of 1/128
/// px and one exact rounding at the end. It commutes with mirroring and with rotation by 90
/// degrees, bit for bit. Meant for shrinking by up to 2: beyond that it skips pixels.
cv::Mat Resize(const cv::Mat& image, cv::Size size);

/// The levels of `image` (8-bit, one channel; level 0 shares its pixels). Level sizes are the
/// input's over `scales`, rounded, at least 1 px; each level is resized from the one before.
std::vector<PyramidLevel> BuildPyramid(const cv::Mat& image, const std::vector<double>& scales);

}  // namespace corvo::orb
