// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The residuals of inliers in one cell of the image.
struct ResidualCell {
  Eigen::Vector2d center;                             ///< px
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();  ///< Observed minus predicted.
  int count = 0;
};

/// Returns the mean residuals in each of `columns` x `rows` cells of the image, row by row.
std::vector<ResidualCell> MeanResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                                        int columns, int rows);

/// Returns the gnuplot script that writes a PNG to standard output, with the mean residuals of the
/// cells as arrows. If they point in the same direction in a region, the model does not fit there.
std::string ResidualPlotScript(const Camera& camera, const std::vector<ResidualCell>& cells);

/// Draws the plot with gnuplot. Returns false and leaves no file if gnuplot is missing or fails.
bool DrawResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                   const std::filesystem::path& png);

}  // namespace corvo
