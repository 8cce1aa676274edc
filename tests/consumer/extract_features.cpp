// The features alone: found on a drawn square, at its corners.

#include <cstdlib>
#include <iostream>

#include <corvo/orb/extractor.h>
#include <opencv2/core.hpp>

int main() {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(0));
  image(cv::Rect(60, 40, 30, 30)).setTo(255);
  const corvo::orb::Features features = corvo::orb::Extractor().Extract(image);
  for (const corvo::orb::Keypoint& keypoint : features.keypoints) {
    std::cout << keypoint.x << ' ' << keypoint.y << ' ' << keypoint.octave << '\n';
  }
  return features.keypoints.size() >= 4 ? EXIT_SUCCESS : EXIT_FAILURE;
}
