// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "orb/types.h"

namespace corvo::test {

/// Returns an image of independent gray levels in [0, 255].
cv::Mat NoiseImage(cv::Size size, std::uint64_t seed);

/// Returns an image of overlapping filled rectangles and triangles of random gray levels in
/// [min_gray, max_gray].
cv::Mat ShapesImage(cv::Size size, std::uint64_t seed, int min_gray = 0, int max_gray = 255);

/// Reads an image of the test data as gray. Fails the test if it cannot be read.
cv::Mat ReadGray(const std::string& relative);

/// Reads the nine numbers of a homography file of the test data. Fails the test if it cannot be
/// read.
cv::Matx33d ReadHomography(const std::string& relative);

/// Returns whether two images have the same size and pixels.
bool SameImage(const cv::Mat& a, const cv::Mat& b);

/// Returns the paths of test-data images that differ in kind: street, wall, trees, room.
const std::vector<std::string>& RealImages();

/// Returns the sum of the 25 pixels around (x, y).
int WindowSum(const cv::Mat& image, int x, int y);

/// Returns descriptors of independent bits.
std::vector<orb::Descriptor> RandomDescriptors(int count, std::uint64_t seed);

}  // namespace corvo::test
