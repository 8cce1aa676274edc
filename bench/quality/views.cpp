// SPDX-License-Identifier: MIT
#include "bench/quality/views.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "orb/error.h"

namespace corvo::bench {
namespace {

cv::Matx33d RotationAbout(double x, double y, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, -s, x - c * x + s * y, s, c, y - s * x - c * y, 0, 0, 1};
}

/// Returns the scaling of images whose pixels are squares centered at integer coordinates.
cv::Matx33d Scaling(double x, double y) {
  return {x, 0, 0.5 * x - 0.5, 0, y, 0.5 * y - 0.5, 0, 0, 1};
}

cv::Mat ApplyLine(const cv::Mat& image, double gain, double offset) {
  cv::Mat changed;
  image.convertTo(changed, CV_8U, gain, offset);
  return changed;
}

}  // namespace

View Rotate(const cv::Mat& image, double angle_deg) {
  View view;
  view.from_first = RotationAbout(0.5 * (image.cols - 1), 0.5 * (image.rows - 1), angle_deg);
  cv::warpAffine(image, view.image, view.from_first.get_minor<2, 3>(0, 0), image.size(),
                 cv::INTER_LINEAR);
  return view;
}

View Scale(const cv::Mat& image, double factor) {
  View view;
  const cv::Size size(static_cast<int>(std::lround(image.cols * factor)),
                      static_cast<int>(std::lround(image.rows * factor)));
  cv::resize(image, view.image, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  view.from_first = Scaling(static_cast<double>(size.width) / image.cols,
                            static_cast<double>(size.height) / image.rows);
  return view;
}

View Blur(const cv::Mat& image, double sigma_px) {
  View view;
  cv::GaussianBlur(image, view.image, cv::Size(), sigma_px);
  return view;
}

View CompressJpeg(const cv::Mat& image, int quality) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return {.image = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE)};
}

View AddBrightness(const cv::Mat& image, double offset) {
  return {.image = ApplyLine(image, 1, offset)};
}

View ChangeContrast(const cv::Mat& image, double gain) {
  return {.image = ApplyLine(image, gain, 128 * (1 - gain))};
}

cv::Mat AddNoise(const cv::Mat& image, double sigma, std::uint64_t seed) {
  if (sigma == 0) return image;
  cv::Mat noise(image.size(), CV_32F);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat noisy;
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  return noisy;
}

cv::Matx33d ReadHomography(const std::string& file) {
  std::ifstream stream(file);
  cv::Matx33d homography;
  for (double& value : homography.val) stream >> value;
  if (!stream) throw Error(file + ": has no three lines of three numbers");
  return homography;
}

}  // namespace corvo::bench
