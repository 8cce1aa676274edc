// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

#include "apps/codecs/codecs.h"

namespace corvo {

/// Converts an image of a ROS message to 8- or 16-bit gray, as it is stored: an image file as
/// DecodeStoredGray() does, color pixels to 0.299 R + 0.587 G + 0.114 B. The mosaic of a color
/// sensor is interpolated linearly to color at every pixel first, so that the gray image has its
/// full size. Of YUV 4:2:2 the luma is kept. `name` is the start of messages. Throws corvo::Error
/// if the encoding is not known, the size is out of range, or bytes are missing.
cv::Mat RosImageToGray(const BagImage& image, const std::string& name);

}  // namespace corvo
