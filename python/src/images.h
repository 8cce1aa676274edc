// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>
#include <opencv2/core/mat.hpp>

namespace corvo::python {

/// Returns an 8-bit gray image. That of a uint8 array of shape (height, width), whose rows are
/// contiguous but may be apart, shares the pixels of the array, which must outlive it. An array of
/// shape (height, width, 3) is RGB and is converted to 0.299 R + 0.587 G + 0.114 B. Throws
/// corvo::Error, naming dtype, shape or strides, for anything else.
cv::Mat ToGrayImage(nanobind::handle image);

/// Returns a copy of a mask, an uint8 array of shape (height, width), or an empty image for None.
/// Throws corvo::Error as ToGrayImage() does.
cv::Mat ToMask(nanobind::handle mask);

/// Returns a uint8 or uint16 array of shape (height, width) that shares the pixels of an 8- or
/// 16-bit gray image, or None for an empty one.
nanobind::object ToArray(const cv::Mat& image);

}  // namespace corvo::python
