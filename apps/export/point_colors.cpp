// SPDX-License-Identifier: MIT
#include "apps/export/point_colors.h"

#include <algorithm>
#include <vector>

#include "apps/dataset/image_reader.h"
#include "apps/output/landmark_colors.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// Returns an empty image if the file cannot be read.
cv::Mat TryReadColorImage(const std::filesystem::path& file, const GrayLevels& levels) {
  try {
    return ReadColorImage(file, levels);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

void ColorPoints(const std::filesystem::path& folder, const GrayLevels& levels,
                 Reconstruction& reconstruction) {
  const cv::Size size(reconstruction.camera.width, reconstruction.camera.height);
  std::vector<bool> is_colored(reconstruction.points.size(), false);
  for (const ReconstructedImage& image : reconstruction.images) {
    const auto is_new = [&](const PointObservation& o) { return !is_colored[o.point]; };
    if (std::ranges::none_of(image.observations, is_new)) continue;
    const cv::Mat pixels = TryReadColorImage(folder / image.name, levels);
    if (pixels.empty()) continue;
    for (const PointObservation& o : image.observations) {
      if (!is_new(o)) continue;
      reconstruction.points[o.point].rgb = ColorAt(o.pixel, size, pixels);
      is_colored[o.point] = true;
    }
  }
}

}  // namespace corvo
