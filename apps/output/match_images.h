// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/matx.hpp>

#include "orb/extractor.h"
#include "orb/matcher.h"

namespace corvo {

/// Maximum reprojection error of inliers of the homography, px.
inline constexpr double kHomographyErrorPx = 3.0;

/// The features and matches of two images.
struct ImageMatches {
  orb::Features first;
  orb::Features second;
  std::vector<orb::Match> matches;  ///< Mutual nearest neighbors, ordered by feature of `first`.
  std::optional<cv::Matx33d> second_from_first;  ///< Homography, if one was found.
  std::vector<char> is_inlier;                   ///< 1 for inliers of the homography, per match.
  int num_inliers = 0;
};

/// Matches two images by mutual nearest neighbors with a distance of at most `max_distance` bits
/// and a ratio test with `max_ratio`, and estimates a homography from the matches (RANSAC, fixed
/// seed).
ImageMatches MatchImages(orb::Features first, orb::Features second, int max_distance,
                         double max_ratio);

}  // namespace corvo
