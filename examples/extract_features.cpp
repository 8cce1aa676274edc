// SPDX-License-Identifier: MIT
// Prints the ORB features of an image, one per line: extract_features IMAGE
#include <cstdlib>
#include <iostream>

#include <corvo/orb/extractor.h>
#include <opencv2/imgcodecs.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: extract_features IMAGE\n";
    return EXIT_FAILURE;
  }
  const cv::Mat image = cv::imread(argv[1], cv::IMREAD_GRAYSCALE);
  corvo::orb::ExtractorOptions options;
  options.num_features = 500;
  const corvo::orb::Features features = corvo::orb::Extractor(options).Extract(image);
  std::cout << "x_px y_px octave angle_deg response\n";
  for (const corvo::orb::Keypoint& keypoint : features.keypoints) {
    std::cout << keypoint.x << ' ' << keypoint.y << ' ' << keypoint.octave << ' '
              << keypoint.angle_deg << ' ' << keypoint.response << '\n';
  }
}
