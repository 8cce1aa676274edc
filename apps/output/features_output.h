// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

#include "apps/output/match_images.h"
#include "apps/output/output_folder.h"
#include "orb/extractor.h"

namespace corvo {

/// Returns CSV with one line per feature: x, y, octave, angle (degrees), response, and the 32 bytes
/// of the descriptor in hexadecimal, first byte first.
std::string FeatureTable(const orb::Features& features);

/// Returns CSV with one line per match: the indices of its features, their pixels, the descriptor
/// distance in bits, and 1 for an inlier of the homography, else 0.
std::string MatchTable(const ImageMatches& matches);

/// Returns the gray image in color with all keypoints: a circle proportional to the size of the
/// descriptor's patch, the keypoint's direction, and one color per octave.
cv::Mat DrawFeatures(const cv::Mat& image, const orb::Features& features,
                     const orb::Extractor& extractor);

/// Returns the gray images side by side with the matches: inliers of the homography green, outliers
/// red.
cv::Mat DrawMatches(const cv::Mat& first, const cv::Mat& second, const ImageMatches& matches);

/// Stages an image file of that name. Throws corvo::Error if it cannot be written.
void WriteImage(const cv::Mat& image, const std::string& name, const OutputFolder& output);

}  // namespace corvo
