// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/matx.hpp>

#include "orb/extractor.h"
#include "orb/matcher.h"

namespace corvo {

/// A match agrees with the homography when it lies this near, px.
inline constexpr double kHomographyErrorPx = 3.0;

/// What two images have in common.
struct ImageMatches {
  orb::Features first;
  orb::Features second;
  std::vector<orb::Match> matches;  ///< Mutual nearest neighbors, by feature of the first.
  std::optional<cv::Matx33d> second_from_first;  ///< Homography that most matches agree with.
  std::vector<char> is_inlier;                   ///< Of each match: agrees with it.
  int num_inliers = 0;
};

/// Matches that are mutual, at most `max_distance` bits apart, and below `max_ratio` times the
/// distance of the second nearest; and the homography between them (RANSAC, fixed seed), if there
/// is one.
ImageMatches MatchImages(orb::Features first, orb::Features second, int max_distance,
                         double max_ratio);

}  // namespace corvo
