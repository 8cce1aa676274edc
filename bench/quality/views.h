// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::bench {

/// An image, and another that shows the same plane.
struct View {
  cv::Mat image;
  cv::Matx33d from_first = cv::Matx33d::eye();  ///< Takes pixels of the first image to this one.
};

/// Turned about its center by an angle from x towards y, bilinearly; black where there is nothing.
View Rotate(const cv::Mat& image, double angle_deg);

/// By area where it shrinks, bilinearly where it grows.
View Scale(const cv::Mat& image, double factor);

View Blur(const cv::Mat& image, double sigma_px);
View CompressJpeg(const cv::Mat& image, int quality);
/// Values outside of 0 to 255 saturate.
View AddBrightness(const cv::Mat& image, double offset);
/// About gray 128; saturates.
View ChangeContrast(const cv::Mat& image, double gain);

/// N(0, sigma) at every pixel; the same for one size and seed.
cv::Mat AddNoise(const cv::Mat& image, double sigma, std::uint64_t seed);

/// The homography in a file of three lines of three numbers. Throws corvo::Error where it has
/// none.
cv::Matx33d ReadHomography(const std::string& file);

}  // namespace corvo::bench
