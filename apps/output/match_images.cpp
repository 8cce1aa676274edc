// SPDX-License-Identifier: MIT
#include "apps/output/match_images.h"

#include <algorithm>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace corvo {
namespace {

constexpr std::size_t kMinHomographyMatches = 4;

cv::Point2f PixelOf(const orb::Keypoint& keypoint) { return {keypoint.x, keypoint.y}; }

void FindHomography(ImageMatches& pair) {
  pair.is_inlier.assign(pair.matches.size(), 0);
  if (pair.matches.size() < kMinHomographyMatches) return;
  std::vector<cv::Point2f> from, to;
  for (const orb::Match& match : pair.matches) {
    from.push_back(PixelOf(pair.first.keypoints[match.query]));
    to.push_back(PixelOf(pair.second.keypoints[match.train]));
  }
  cv::Mat mask;
  const cv::Mat homography = cv::findHomography(from, to, cv::RANSAC, kHomographyErrorPx, mask);
  if (homography.empty()) return;
  pair.second_from_first = cv::Matx33d(homography);
  std::copy(mask.begin<char>(), mask.end<char>(), pair.is_inlier.begin());
  pair.num_inliers = cv::countNonZero(mask);
}

}  // namespace

ImageMatches MatchImages(orb::Features first, orb::Features second, int max_distance,
                         double max_ratio) {
  ImageMatches pair{std::move(first), std::move(second), {}, {}, {}, 0};
  const auto& queries = pair.first.descriptors;
  const auto& train = pair.second.descriptors;
  const auto distinct = orb::RatioTest(orb::FindNearest(queries, train), max_ratio);
  pair.matches =
      orb::CrossCheck(orb::DistanceTest(distinct, max_distance), orb::FindNearest(train, queries));
  FindHomography(pair);
  return pair;
}

}  // namespace corvo
