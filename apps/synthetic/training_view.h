// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

namespace corvo {

/// An image seen again, as a camera might.
struct TrainingView {
  cv::Mat image;
  cv::Matx33d view_from_image;  ///< Homography of pixels.
};

/// A seeded view of a gray image: turned by any angle, 0.8 to 1.25 times as large, stretched and
/// sheared by up to 0.2, in slight perspective; blurred by up to 1 px, with another gain and offset
/// and noise of up to 5 gray levels. Beyond its edges the image is mirrored. The same bytes on
/// every machine.
TrainingView MakeTrainingView(const cv::Mat& image, std::uint64_t seed);

}  // namespace corvo
