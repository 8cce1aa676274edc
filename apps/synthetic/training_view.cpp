// SPDX-License-Identifier: MIT
#include "apps/synthetic/training_view.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "apps/synthetic/random.h"
#include "orb/pattern.h"

namespace corvo {
namespace {

using synthetic::Random;

cv::Point2d Apply(const cv::Matx33d& homography, double x, double y) {
  const cv::Vec3d mapped = homography * cv::Vec3d(x, y, 1);
  return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
}

/// Returns a random homography about the image's center, which it maps to the origin.
cv::Matx33d RandomHomography(cv::Size size, Random& random) {
  constexpr int kDirections = 3600;
  constexpr double kMaxShear = 0.2;
  constexpr double kMaxPerspective = 3e-4;  // per pixel
  const orb::Direction turn = orb::DirectionOf(random.Between(0, kDirections - 1), kDirections);
  const double scale = random.Uniform(0.8, 1.25);
  const double stretch = random.Uniform(1 - kMaxShear, 1 + kMaxShear);
  const double shear = random.Uniform(-kMaxShear, kMaxShear);
  const double perspective_x = random.Uniform(-kMaxPerspective, kMaxPerspective);
  const double perspective_y = random.Uniform(-kMaxPerspective, kMaxPerspective);
  const cv::Matx33d rotation(turn.cosine, -turn.sine, 0, turn.sine, turn.cosine, 0, 0, 0, 1);
  const cv::Matx33d affine(scale * stretch, shear, 0, 0, scale / stretch, 0, 0, 0, 1);
  const cv::Matx33d perspective(1, 0, 0, 0, 1, 0, perspective_x, perspective_y, 1);
  const cv::Matx33d centring(1, 0, -0.5 * size.width, 0, 1, -0.5 * size.height, 0, 0, 1);
  return rotation * affine * perspective * centring;
}

/// Returns the bounding box of an image transformed by a homography.
cv::Rect2d BoxAround(const cv::Matx33d& homography, cv::Size size) {
  cv::Point2d low = Apply(homography, 0, 0);
  cv::Point2d high = low;
  for (const auto& [x, y] : {cv::Point(size.width - 1, 0), cv::Point(0, size.height - 1),
                             cv::Point(size.width - 1, size.height - 1)}) {
    const cv::Point2d corner = Apply(homography, x, y);
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  return {low, high};
}

cv::Mat Warp(const cv::Mat& image, const cv::Matx33d& view_from_image, cv::Size size) {
  const cv::Matx33d image_from_view = view_from_image.inv();
  cv::Mat columns(size, CV_32FC1);
  cv::Mat rows(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const cv::Point2d source = Apply(image_from_view, x, y);
      columns.at<float>(y, x) = static_cast<float>(source.x);
      rows.at<float>(y, x) = static_cast<float>(source.y);
    }
  }
  cv::Mat view;
  cv::remap(image, view, columns, rows, cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  return view;
}

/// Returns a nearly normal sample of standard deviation 1, from the sum of eight bytes.
double SampleNoise(Random& random) {
  constexpr double kMean = 8 * 127.5;
  constexpr double kSigma = 209.02;  // sqrt(8 (256^2 - 1) / 12)
  int sum = 0;
  for (std::uint64_t bytes = random.Next(); bytes != 0; bytes >>= 8) sum += bytes & 0xff;
  return (sum - kMean) / kSigma;
}

/// Changes the exposure and adds noise.
void ChangeGray(Random& random, cv::Mat& view) {
  const double gain = random.Uniform(0.75, 1.33);
  const double offset = random.Uniform(-20, 20);
  const double noise_sigma = random.Uniform(0, 5);
  for (int y = 0; y < view.rows; ++y) {
    for (int x = 0; x < view.cols; ++x) {
      auto& gray = view.at<std::uint8_t>(y, x);
      const double changed = 128 + gain * (gray - 128) + offset + noise_sigma * SampleNoise(random);
      gray = static_cast<std::uint8_t>(std::clamp(changed + 0.5, 0.0, 255.0));
    }
  }
}

}  // namespace

TrainingView MakeTrainingView(const cv::Mat& image, std::uint64_t seed) {
  constexpr double kLeastBlur = 0.3;  // px; less blur has no effect.
  Random random(seed);
  const cv::Matx33d centered = RandomHomography(image.size(), random);
  const cv::Rect2d box = BoxAround(centered, image.size());
  const cv::Matx33d moving(1, 0, -box.x, 0, 1, -box.y, 0, 0, 1);
  TrainingView view;
  view.view_from_image = moving * centered;
  const cv::Size size(static_cast<int>(box.width) + 1, static_cast<int>(box.height) + 1);
  view.image = Warp(image, view.view_from_image, size);
  const double blur_sigma = random.Uniform(0, 1);
  if (blur_sigma > kLeastBlur) {
    cv::GaussianBlur(view.image, view.image, cv::Size(), blur_sigma, blur_sigma);
  }
  ChangeGray(random, view.image);
  return view;
}

}  // namespace corvo
