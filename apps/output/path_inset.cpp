// SPDX-License-Identifier: MIT
#include "apps/output/path_inset.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace corvo {
namespace {

constexpr double kShare = 0.27;      // Of the shorter side of the image.
constexpr double kBrightness = 0.3;  // Of the image behind the path.
constexpr int kFractionalBits = 4;   // Fractional bits of coordinates that are drawn.

const cv::Scalar kPath(255, 255, 255);
const cv::Scalar kCamera(0, 159, 230);  // BGR
const cv::Scalar kFrame(120, 120, 120);

}  // namespace

void PathInset::Add(const FrameResult& frame) {
  if (!frame.world_from_camera) return;
  if (frame.segment != segment_) path_.clear();
  segment_ = frame.segment;
  const Eigen::Vector3d& position = frame.world_from_camera->translation();
  path_.emplace_back(position.x(), position.z());
}

void PathInset::Draw(cv::Mat& image) const {
  if (path_.size() < 2) return;
  const int side = static_cast<int>(std::lround(kShare * std::min(image.cols, image.rows)));
  const int gap = side / 16;
  cv::Mat inset = image(cv::Rect(image.cols - side - gap, gap, side, side));
  inset.convertTo(inset, -1, kBrightness);
  cv::rectangle(inset, {0, 0, side, side}, kFrame, 1);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& position : path_) box.extend(position);
  const double scale = 0.8 * side / std::max(box.sizes().maxCoeff(), 1e-12);
  std::vector<cv::Point> pixels;
  for (const Eigen::Vector2d& position : path_) {
    const Eigen::Vector2d offset = scale * (position - box.center());
    pixels.emplace_back(std::lround((0.5 * side + offset.x()) * (1 << kFractionalBits)),
                        std::lround((0.5 * side - offset.y()) * (1 << kFractionalBits)));
  }
  const int thickness = std::max(1, side / 100);
  cv::polylines(inset, pixels, false, kPath, thickness, cv::LINE_AA, kFractionalBits);
  const int radius = std::max(2, side / 40);
  cv::circle(inset, pixels.back(), radius << kFractionalBits, kCamera, -1, cv::LINE_AA,
             kFractionalBits);
}

}  // namespace corvo
