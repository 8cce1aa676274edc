// SPDX-License-Identifier: MIT
// Estimates the motion between two images with the individual stages: two_views IMAGE IMAGE
#include <cstdlib>
#include <iostream>
#include <vector>

#include <corvo/orb/extractor.h>
#include <corvo/orb/matcher.h>
#include <corvo/vo/camera/camera.h>
#include <corvo/vo/geometry/two_view.h>
#include <opencv2/imgcodecs.hpp>

namespace {

/// Returns the mutual nearest neighbors that pass the ratio test and the distance test.
std::vector<corvo::orb::Match> MatchFeatures(const corvo::orb::Features& first,
                                             const corvo::orb::Features& second) {
  const auto forward = corvo::orb::FindNearest(first.descriptors, second.descriptors);
  const auto backward = corvo::orb::FindNearest(second.descriptors, first.descriptors);
  const auto distinct = corvo::orb::RatioTest(forward, 0.8);
  return corvo::orb::CrossCheck(corvo::orb::DistanceTest(distinct, 65), backward);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: two_views IMAGE IMAGE\n";
    return EXIT_FAILURE;
  }
  const corvo::Camera camera(
      {.width = 640, .height = 480, .fx = 525, .fy = 525, .cx = 319.5, .cy = 239.5});
  const corvo::orb::Extractor extractor;
  const auto first = extractor.Extract(cv::imread(argv[1], cv::IMREAD_GRAYSCALE));
  const auto second = extractor.Extract(cv::imread(argv[2], cv::IMREAD_GRAYSCALE));

  std::vector<corvo::RayMatch> rays;
  for (const corvo::orb::Match& match : MatchFeatures(first, second)) {
    const corvo::orb::Keypoint& a = first.keypoints[match.query];
    const corvo::orb::Keypoint& b = second.keypoints[match.train];
    const auto ray_a = camera.Undistort({a.x, a.y});
    const auto ray_b = camera.Undistort({b.x, b.y});
    if (ray_a && ray_b) rays.push_back({*ray_a, *ray_b, 1 / camera.focal()});
  }
  const corvo::TwoViewResult motion = corvo::EstimateTwoViewMotion(rays, {});
  if (motion.reason != corvo::Reason::kNone) {
    std::cout << "no motion: " << ToString(motion.reason) << '\n';
    return EXIT_SUCCESS;
  }
  const corvo::SE3 first_from_second = motion.first_from_second;  // The baseline has length 1.
  std::cout << motion.num_inliers << " inliers of " << rays.size()
            << " matches\nrotation, rad: " << first_from_second.rotation().Log().transpose()
            << "\ndirection of the baseline: " << first_from_second.translation().transpose()
            << '\n';
}
