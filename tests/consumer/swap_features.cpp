// corvo's features in the place of OpenCV's: one line differs.

#include <cstdlib>
#include <iostream>
#include <vector>

#include <corvo/orb/opencv.h>
#include <opencv2/features2d.hpp>

int main() {
  cv::Mat image(240, 320, CV_8UC1);
  cv::RNG(1).fill(image, cv::RNG::UNIFORM, 0, 256);
  const cv::Ptr<cv::Feature2D> features = corvo::orb::CreateFeature2D(200);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  features->detectAndCompute(image, cv::noArray(), keypoints, descriptors);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(features->defaultNorm(), true).match(descriptors, descriptors, matches);
  std::cout << matches.size() << " matches\n";
  return matches.size() == 200 ? EXIT_SUCCESS : EXIT_FAILURE;
}
