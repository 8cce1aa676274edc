// SPDX-License-Identifier: MIT
// Matches two images with OpenCV, using corvo's features in place of cv::ORB's:
// opencv_features IMAGE IMAGE
#include <cstdlib>
#include <iostream>
#include <vector>

#include <corvo/orb/opencv.h>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: opencv_features IMAGE IMAGE\n";
    return EXIT_FAILURE;
  }
  const cv::Ptr<cv::Feature2D> orb =
      corvo::orb::CreateFeature2D(1000);  // Replaces cv::ORB::create(1000).
  std::vector<cv::KeyPoint> keypoints[2];
  cv::Mat descriptors[2];
  for (int i = 0; i < 2; ++i) {
    orb->detectAndCompute(cv::imread(argv[i + 1]), cv::noArray(), keypoints[i], descriptors[i]);
  }
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(orb->defaultNorm(), true).match(descriptors[0], descriptors[1], matches);
  std::cout << matches.size() << " mutual matches\n";
}
