// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

namespace corvo {

/// A synthetic view of an image.
struct TrainingView {
  cv::Mat image;
  cv::Matx33d view_from_image;  ///< Homography of pixels.
};

/// Returns a random view of a gray image: rotated by any angle, scaled by 0.8 to 1.25, stretched
/// and sheared by up to 0.2, in slight perspective; blurred by up to 1 px, with a different gain
/// and offset and noise of up to 5 gray levels. The image is mirrored beyond its borders. The
/// result depends only on the seed and is the same on every machine.
TrainingView MakeTrainingView(const cv::Mat& image, std::uint64_t seed);

}  // namespace corvo
