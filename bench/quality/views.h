// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::bench {

/// A second image of a plane and its homography from the first.
struct View {
  cv::Mat image;
  cv::Matx33d from_first = cv::Matx33d::eye();  ///< Maps pixels of the first image to `image`.
};

/// Rotates an image about its center by an angle from x towards y with bilinear interpolation.
/// Pixels from outside the image are black.
View Rotate(const cv::Mat& image, double angle_deg);

/// Scales an image by area averaging if it shrinks, else with bilinear interpolation.
View Scale(const cv::Mat& image, double factor);

View Blur(const cv::Mat& image, double sigma_px);
View CompressJpeg(const cv::Mat& image, int quality);
/// Adds an offset to every pixel; values outside 0 to 255 saturate.
View AddBrightness(const cv::Mat& image, double offset);
/// Scales gray levels about 128; values outside 0 to 255 saturate.
View ChangeContrast(const cv::Mat& image, double gain);

/// Adds Gaussian noise to every pixel. The noise depends on the size and `seed` only.
cv::Mat AddNoise(const cv::Mat& image, double sigma, std::uint64_t seed);

/// Reads a homography from a file of three lines of three numbers. Throws corvo::Error if the file
/// does not have them.
cv::Matx33d ReadHomography(const std::string& file);

}  // namespace corvo::bench
