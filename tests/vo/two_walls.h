// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/point_scene.h"
#include "tests/support/random.h"
#include "vo/camera/camera.h"

namespace corvo::test {

inline constexpr TimeNs kFrameTime = 100'000'000;

/// Makes seeded noise of uniform 8 x 8 px blocks, whose corners are good ORB features.
inline cv::Mat MakeTexture(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat texture(height / 8, width / 8, CV_8UC1);
  for (int y = 0; y < texture.rows; ++y) {
    for (int x = 0; x < texture.cols; ++x) {
      texture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.UniformInt(20, 235));
    }
  }
  cv::resize(texture, texture, {width, height}, 0, 0, cv::INTER_NEAREST);
  return texture;
}

/// Two parallel textured walls, the nearer one across the middle of the image. Render() takes the
/// position of the camera along x.
class TwoWalls {
 public:
  explicit TwoWalls(std::uint64_t seed, int width = 1600)
      : near_(MakeTexture(width, 240, seed)), far_(MakeTexture(width, 480, seed + 1)) {}

  cv::Mat Render(double x) const {
    cv::Mat image;
    cv::getRectSubPix(far_, {640, 480}, cv::Point2d(500 + 500 * x / 8, 239.5), image);
    cv::Mat near;
    cv::getRectSubPix(near_, {640, 240}, cv::Point2d(500 + 500 * x / 4, 119.5), near);
    near.copyTo(image.rowRange(120, 360));
    return image;
  }

 private:
  cv::Mat near_, far_;
};

/// Renders a steady drive along two walls, 0.1 per frame.
inline std::vector<cv::Mat> MakeDrive(int num_frames, std::uint64_t seed) {
  const TwoWalls walls(seed);
  std::vector<cv::Mat> images;
  for (int i = 0; i < num_frames; ++i) images.push_back(walls.Render(0.1 * i));
  return images;
}

/// Renders a drive of any length along two walls, 0.1 per frame, in images of 320 x 240 px.
inline std::vector<cv::Mat> MakeLongDrive(int num_frames) {
  const TwoWalls walls(11, 1600 + 13 * num_frames);
  std::vector<cv::Mat> images;
  for (int i = 0; i < num_frames; ++i) {
    cv::Mat image;
    cv::resize(walls.Render(0.1 * i), image, {320, 240}, 0, 0, cv::INTER_AREA);
    images.push_back(image);
  }
  return images;
}

inline Camera LongDriveCamera() { return PinholeCamera().Resized(320, 240); }

}  // namespace corvo::test
