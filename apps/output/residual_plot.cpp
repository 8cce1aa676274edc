// SPDX-License-Identifier: MIT
#include "apps/output/residual_plot.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

#include "apps/output/gnuplot.h"

namespace corvo {
namespace {

constexpr int kColumns = 24;
constexpr int kMinCount = 5;  // Means of fewer residuals are noise.

/// Returns the ratio of arrow length to residual with which the longest arrow spans a cell.
double Magnification(const Camera& camera, const std::vector<ResidualCell>& cells) {
  constexpr double kSmallest_px = 1e-3;
  double longest = kSmallest_px;
  for (const ResidualCell& cell : cells) {
    if (cell.count >= kMinCount) longest = std::max(longest, cell.mean_px.norm());
  }
  return static_cast<double>(camera.width()) / kColumns / longest;
}

}  // namespace

std::vector<ResidualCell> MeanResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                                        int columns, int rows) {
  const Eigen::Vector2d size(static_cast<double>(camera.width()) / columns,
                             static_cast<double>(camera.height()) / rows);
  std::vector<ResidualCell> cells;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      cells.push_back({size.cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5)).array() - 0.5});
    }
  }
  for (const Bundle& bundle : bundles) {
    const std::vector<std::optional<Eigen::Vector2d>> predicted = PredictPixels(camera, bundle);
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      const Bundle::Observation& observation = bundle.observations[i];
      if (!observation.is_inlier || !camera.Contains(observation.pixel) || !predicted[i]) continue;
      const int column = static_cast<int>((observation.pixel.x() + 0.5) / size.x());
      const int row = static_cast<int>((observation.pixel.y() + 0.5) / size.y());
      ResidualCell& cell = cells[std::min(row, rows - 1) * columns + std::min(column, columns - 1)];
      ++cell.count;
      cell.mean_px += (observation.pixel - *predicted[i] - cell.mean_px) / cell.count;
    }
  }
  return cells;
}

std::string ResidualPlotScript(const Camera& camera, const std::vector<ResidualCell>& cells) {
  const double magnification = Magnification(camera, cells);
  std::string script = fmt::format(
      "set terminal pngcairo size 1200,{}\nset title 'mean residuals of inliers, {:.0f}x'\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset size ratio -1\nset xlabel 'x [px]'\n"
      "set ylabel 'y [px]'\nset cblabel 'inliers'\nset key off\n$cells << EOD\n",
      std::clamp(1200 * camera.height() / camera.width() + 150, 400, 1400), magnification,
      camera.width() - 0.5, camera.height() - 0.5);
  for (const ResidualCell& cell : cells) {
    if (cell.count < kMinCount) continue;
    const Eigen::Vector2d arrow = magnification * cell.mean_px;
    script += fmt::format("{:.2f} {:.2f} {:.3f} {:.3f} {}\n", cell.center.x(), cell.center.y(),
                          arrow.x(), arrow.y(), cell.count);
  }
  return script + "EOD\nplot $cells using 1:2:3:4:5 with vectors lw 2 lc palette\n";
}

bool DrawResiduals(const Camera& camera, const std::vector<Bundle>& bundles,
                   const std::filesystem::path& png) {
  const int rows = std::max(1, kColumns * camera.height() / camera.width());
  return RunGnuplot(ResidualPlotScript(camera, MeanResiduals(camera, bundles, kColumns, rows)),
                    png);
}

}  // namespace corvo
