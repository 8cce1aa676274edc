// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "orb/types.h"

namespace corvo::test {

/// Independent gray levels in [0, 255].
cv::Mat NoiseImage(cv::Size size, std::uint64_t seed);

/// Overlapping filled rectangles and triangles of random gray levels in [min_gray, max_gray].
cv::Mat ShapesImage(cv::Size size, std::uint64_t seed, int min_gray = 0, int max_gray = 255);

/// A gray image of the test data. Fails the test if it cannot be read.
cv::Mat ReadGray(const std::string& relative);

/// The nine numbers of a file of the test data. Fails the test if it cannot be read.
cv::Matx33d ReadHomography(const std::string& relative);

/// Images of the test data that differ in kind: street, wall, trees, room.
const std::vector<std::string>& RealImages();

/// Of the 25 pixels around (x, y).
int WindowSum(const cv::Mat& image, int x, int y);

/// Independent bits.
std::vector<orb::Descriptor> RandomDescriptors(int count, std::uint64_t seed);

}  // namespace corvo::test
