// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace corvo::test {

/// Random texture with detail down to a few pixels.
inline cv::Mat MakeSmoothTexture(int width, int height) {
  cv::RNG random(7);
  cv::Mat noise(height, width, CV_8UC1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, cv::Size(), 3);
  cv::normalize(noise, noise, 30, 220, cv::NORM_MINMAX);
  return noise;
}

/// Returns an image moved by an affine transform, of the same size.
inline cv::Mat Move(const cv::Mat& image, const cv::Mat& transform) {
  cv::Mat moved;
  cv::warpAffine(image, moved, transform, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return moved;
}

inline cv::Mat Shift(const cv::Mat& image, double dx, double dy) {
  return Move(image, cv::Mat(cv::Matx23d(1, 0, dx, 0, 1, dy)));
}

/// Returns an image turned about its center and zoomed.
inline cv::Mat TurnAndZoom(const cv::Mat& image, double degrees, double factor) {
  const cv::Point2f center(image.cols / 2.f, image.rows / 2.f);
  return Move(image, cv::getRotationMatrix2D(center, degrees, factor));
}

}  // namespace corvo::test
