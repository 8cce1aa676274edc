#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "orb/types.h"

namespace corvo::test {

/// Independent grey levels in [0, 255].
cv::Mat NoiseImage(cv::Size size, std::uint64_t seed);

/// Overlapping filled rectangles and triangles of random grey levels in [min_grey, max_grey].
cv::Mat ShapesImage(cv::Size size, std::uint64_t seed, int min_grey = 0, int max_grey = 255);

/// A grey image of the test data. Fails the test if it cannot be read.
cv::Mat ReadGrey(const std::string& relative);

/// The nine numbers of a file of the test data. Fails the test if it cannot be read.
cv::Matx33d ReadHomography(const std::string& relative);

/// Pictures of the test data that differ in kind: street, wall, trees, room.
const std::vector<std::string>& RealImages();

/// Of the 25 pixels around (x, y).
int WindowSum(const cv::Mat& image, int x, int y);

/// Independent bits.
std::vector<orb::Descriptor> RandomDescriptors(int count, std::uint64_t seed);

}  // namespace corvo::test
