// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Inliers' errors in one cell of the image.
struct ResidualCell {
  Eigen::Vector2d center;                             ///< px
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();  ///< Seen minus predicted.
  int count = 0;
};

/// What a camera leaves over in each cell of `columns` x `rows` of its image, row by row.
std::vector<ResidualCell> MeanResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                                        int columns, int rows);

/// The gnuplot script that draws the cells' mean errors as arrows over the image, as PNG, to
/// standard output: where they point the same way in a region, the model does not fit there.
std::string ResidualPlotScript(const Camera& camera, const std::vector<ResidualCell>& cells);

/// Draws with gnuplot. False, with no file left, where gnuplot is missing or fails.
bool DrawResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                   const std::filesystem::path& png);

}  // namespace corvo
