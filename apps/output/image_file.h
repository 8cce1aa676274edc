// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

namespace corvo {

/// Returns the content of an image file with this extension (".png", ".jpg"). Unlike a file that
/// OpenCV writes, it can be written with every error reported.
std::string EncodeImage(const cv::Mat& image, const std::string& extension);

}  // namespace corvo
