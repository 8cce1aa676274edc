// SPDX-License-Identifier: MIT
#include "tests/orb/images.h"

#include <gtest/gtest.h>

#include <fstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/data.h"
#include "tests/support/random.h"

namespace corvo::test {

cv::Mat NoiseImage(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.UniformInt(0, 255));
    }
  }
  return image;
}

cv::Mat ShapesImage(cv::Size size, std::uint64_t seed, int min_gray, int max_gray) {
  Random random(seed);
  cv::Mat image(size, CV_8UC1, cv::Scalar(min_gray));
  const auto point = [&](cv::Point near, int reach) {
    const int x = near.x + random.UniformInt(-reach, reach);
    return cv::Point(x, near.y + random.UniformInt(-reach, reach));
  };
  for (int i = 0; i < size.area() / 150; ++i) {
    const int x = random.UniformInt(0, size.width);
    const cv::Point center(x, random.UniformInt(0, size.height));
    const cv::Scalar gray(random.UniformInt(min_gray, max_gray));
    const cv::Point a = point(center, 20), b = point(center, 20), c = point(center, 20);
    if (random.UniformInt(0, 1) == 0) {
      cv::rectangle(image, a, b, gray, cv::FILLED);
    } else {
      cv::fillConvexPoly(image, std::vector<cv::Point>{a, b, c}, gray);
    }
  }
  return image;
}

cv::Mat ReadGray(const std::string& relative) {
  cv::Mat image = cv::imread(DataPath(relative).string(), cv::IMREAD_GRAYSCALE);
  EXPECT_FALSE(image.empty()) << "cannot read " << DataPath(relative);
  return image;
}

cv::Matx33d ReadHomography(const std::string& relative) {
  cv::Matx33d homography;
  std::ifstream file(DataPath(relative));
  for (double& entry : homography.val) file >> entry;
  EXPECT_TRUE(file) << relative;
  return homography;
}

bool SameImage(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

const std::vector<std::string>& RealImages() {
  static const std::vector<std::string> paths = {
      "kitti/sequences/03/image_0/000000.png", "oxford_affine/graf/img1.ppm",
      "oxford_affine/boat/img1.pgm", "bsds500/train/100075.jpg", "bsds500/train/135069.jpg"};
  return paths;
}

int WindowSum(const cv::Mat& image, int x, int y) {
  int sum = 0;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) sum += image.at<std::uint8_t>(y + dy, x + dx);
  }
  return sum;
}

std::vector<orb::Descriptor> RandomDescriptors(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<orb::Descriptor> descriptors(count);
  for (auto& descriptor : descriptors) {
    for (auto& byte : descriptor.bytes) byte = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  }
  return descriptors;
}

}  // namespace corvo::test
