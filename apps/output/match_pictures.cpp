#include "apps/output/match_pictures.h"

#include <algorithm>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace corvo {
namespace {

constexpr std::size_t kMinHomographyMatches = 4;

cv::Point2f PixelOf(const orb::Keypoint& keypoint) { return {keypoint.x, keypoint.y}; }

void FindHomography(PictureMatches& pictures) {
  pictures.is_inlier.assign(pictures.matches.size(), 0);
  if (pictures.matches.size() < kMinHomographyMatches) return;
  std::vector<cv::Point2f> from, to;
  for (const orb::Match& match : pictures.matches) {
    from.push_back(PixelOf(pictures.first.keypoints[match.query]));
    to.push_back(PixelOf(pictures.second.keypoints[match.train]));
  }
  cv::Mat mask;
  const cv::Mat homography = cv::findHomography(from, to, cv::RANSAC, kHomographyErrorPx, mask);
  if (homography.empty()) return;
  pictures.second_from_first = cv::Matx33d(homography);
  std::copy(mask.begin<char>(), mask.end<char>(), pictures.is_inlier.begin());
  pictures.num_inliers = cv::countNonZero(mask);
}

}  // namespace

PictureMatches MatchPictures(orb::Features first, orb::Features second, int max_distance,
                             double max_ratio) {
  PictureMatches pictures{std::move(first), std::move(second), {}, {}, {}, 0};
  const auto& queries = pictures.first.descriptors;
  const auto& train = pictures.second.descriptors;
  const auto distinct = orb::KeepDistinct(orb::FindNearest(queries, train), max_ratio);
  pictures.matches =
      orb::KeepMutual(orb::KeepNear(distinct, max_distance), orb::FindNearest(train, queries));
  FindHomography(pictures);
  return pictures;
}

}  // namespace corvo
