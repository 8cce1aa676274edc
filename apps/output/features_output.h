// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

#include "apps/output/match_images.h"
#include "apps/output/output_folder.h"
#include "orb/extractor.h"

namespace corvo {

/// CSV, a line a feature: x, y, octave, angle (degrees), response, and the descriptor's 32 bytes in
/// hexadecimal, the first byte first.
std::string FeatureTable(const orb::Features& features);

/// CSV, a line a match: its features' lines in their tables (from 0), their pixels, the distance
/// (bits), and 1 where it agrees with the homography.
std::string MatchTable(const ImageMatches& matches);

/// The gray image in color with every keypoint: a circle in proportion to the patch it is
/// described from, its direction, and a color for each octave.
cv::Mat DrawFeatures(const cv::Mat& image, const orb::Features& features,
                     const orb::Extractor& extractor);

/// The gray images side by side with the matches: green where they agree with the homography,
/// else red.
cv::Mat DrawMatches(const cv::Mat& first, const cv::Mat& second, const ImageMatches& matches);

/// Stages an image of that name. Throws corvo::Error where it cannot be written.
void WriteImage(const cv::Mat& image, const std::string& name, const OutputFolder& output);

}  // namespace corvo
