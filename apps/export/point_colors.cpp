// SPDX-License-Identifier: MIT
#include "apps/export/point_colors.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgcodecs.hpp>

namespace corvo {
namespace {

/// Returns the pixel of an image of size `new_size` that shows what `pixel` shows in one of `size`,
/// along one axis.
int Rescale(double pixel, int size, int new_size) {
  return std::clamp(static_cast<int>((pixel + 0.5) * new_size / size), 0, new_size - 1);
}

}  // namespace

void ColorPoints(const std::filesystem::path& folder, Reconstruction& reconstruction) {
  const CameraParameters& camera = reconstruction.camera;
  std::vector<bool> is_colored(reconstruction.points.size(), false);
  for (const ReconstructedImage& image : reconstruction.images) {
    const auto is_new = [&](const PointObservation& o) { return !is_colored[o.point]; };
    if (std::ranges::none_of(image.observations, is_new)) continue;
    const cv::Mat pixels = cv::imread((folder / image.name).string(),
                                      cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (pixels.empty()) continue;
    for (const PointObservation& o : image.observations) {
      if (!is_new(o)) continue;
      const auto& bgr = pixels.at<cv::Vec3b>(Rescale(o.pixel.y(), camera.height, pixels.rows),
                                             Rescale(o.pixel.x(), camera.width, pixels.cols));
      reconstruction.points[o.point].rgb = {bgr[2], bgr[1], bgr[0]};
      is_colored[o.point] = true;
    }
  }
}

}  // namespace corvo
