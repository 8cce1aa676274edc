// SPDX-License-Identifier: MIT
#include "tests/system/disturbances.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vo/camera/camera.h"

namespace corvo::test {
namespace {

/// Returns smooth noise of several sizes, which is as rich in corners as sheet metal with
/// lettering.
cv::Mat MakeVehicleTexture(const cv::Size& size, Random& random) {
  cv::Mat sum(size, CV_32FC1, cv::Scalar(0));
  for (const int cell : {6, 12, 40}) {
    cv::Mat noise(size.height / cell + 2, size.width / cell + 2, CV_32FC1);
    for (float& value : cv::Mat_<float>(noise)) value = static_cast<float>(random.Uniform(0, 85));
    cv::resize(noise, noise, size, 0, 0, cv::INTER_LINEAR);
    sum += noise;
  }
  cv::Mat texture;
  sum.convertTo(texture, CV_8U);
  return texture;
}

/// Pastes a texture with its upper left corner at a subpixel position.
void Paste(const cv::Mat& texture, const cv::Point2d& corner, cv::Mat& image) {
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, corner.x, 0, 1, corner.y);
  const cv::Mat whole(texture.size(), CV_8UC1, cv::Scalar(255));
  cv::Mat shifted, mask;
  cv::warpAffine(texture, shifted, shift, image.size());
  cv::warpAffine(whole, mask, shift, image.size());
  shifted.copyTo(image, mask > 128);
}

cv::Size VehicleSize(const Vehicle& vehicle, const cv::Size& image) {
  const double height_share =
      vehicle.motion == VehicleMotion::kAhead ? std::sqrt(vehicle.share) : 0.85;
  return {static_cast<int>(image.width * vehicle.share / height_share),
          static_cast<int>(image.height * height_share)};
}

/// Returns the upper left corner of the vehicle in its k-th image.
cv::Point2d VehicleCorner(const Vehicle& vehicle, const cv::Size& size, const cv::Size& image,
                          int k) {
  const double last = std::max(1, vehicle.num_frames - 1);
  // 1 outside of the image, 0 at its place.
  constexpr double kEntry = 8;
  const double away = std::max({0.0, 1 - k / kEntry, 1 - (last - k) / kEntry});
  const double sway = 0.005 * image.width * std::sin(k / 3.0);
  switch (vehicle.motion) {
    case VehicleMotion::kCrossing:
      return {-size.width + (image.width + size.width) * k / last, 0.12 * image.height};
    case VehicleMotion::kBeside:
      return {sway - away * size.width, 0.05 * image.height};
    case VehicleMotion::kAhead:
      return {(image.width - size.width) / 2.0 + sway + away * image.width,
              0.7 * (image.height - size.height)};
  }
  return {};
}

}  // namespace

Recording Repeat(const Recording& recording, int times, Random& random) {
  Recording repeated;
  repeated.camera = recording.camera;
  for (int i = 0; i < recording.size(); ++i) {
    const TimeNs time_ns = recording.images[i].time_ns;
    const TimeNs next_ns = i + 1 < recording.size() ? recording.images[i + 1].time_ns
                                                    : 2 * time_ns - recording.images[i - 1].time_ns;
    for (int k = 0; k < times; ++k) {
      cv::Mat image = recording.images[i].image.clone();
      if (k > 0) image += cv::Scalar(random.UniformInt(-1, 1));
      repeated.images.push_back({image, time_ns + (next_ns - time_ns) * k / times});
      repeated.truth.push_back(
          {repeated.images.back().time_ns, recording.truth[i].world_from_camera});
    }
  }
  return repeated;
}

Recording AddOverlay(Recording recording, double share, Random& random) {
  const cv::Size size = recording.images.front().image.size();
  const int top = static_cast<int>(size.height * (1 - share));
  const cv::Mat texture = MakeVehicleTexture({size.width, size.height - top}, random);
  for (TimedImage& image : recording.images) {
    image.image = image.image.clone();
    texture.copyTo(image.image.rowRange(top, size.height));
  }
  return recording;
}

Recording AddVehicle(Recording recording, const Vehicle& vehicle, Random& random) {
  const cv::Size image_size = recording.images.front().image.size();
  const cv::Size size = VehicleSize(vehicle, image_size);
  const cv::Mat texture = MakeVehicleTexture(size, random);
  for (int k = 0; k < vehicle.num_frames; ++k) {
    const int i = vehicle.first_frame + k;
    if (i >= recording.size()) break;
    cv::Mat& image = recording.images[i].image;
    image = image.clone();
    Paste(texture, VehicleCorner(vehicle, size, image_size, k), image);
  }
  return recording;
}

Recording CutTo(const Recording& first, const Recording& second) {
  Recording cut = first;
  const int half = first.size() / 2;
  cut.images.resize(half);
  cut.truth.resize(half);
  const TimeNs step_ns = first.images[1].time_ns - first.images[0].time_ns;
  const SE3 placement =
      cut.truth.back().world_from_camera * second.truth[half].world_from_camera.Inverse();
  for (int i = half; i < std::min(first.size(), second.size()); ++i) {
    const TimeNs time_ns = cut.images.back().time_ns + step_ns;
    cut.images.push_back({second.images[i].image, time_ns});
    cut.truth.push_back({time_ns, placement * second.truth[i].world_from_camera});
  }
  return cut;
}

Recording Blur(Recording recording, double sigma_px, int first_frame, int num_frames) {
  for (int i = first_frame; i < std::min(recording.size(), first_frame + num_frames); ++i) {
    cv::Mat blurred;
    cv::GaussianBlur(recording.images[i].image, blurred, {}, sigma_px);
    recording.images[i].image = blurred;
  }
  return recording;
}

Recording Scale(Recording recording, double factor) {
  const cv::Size size(static_cast<int>(std::lround(recording.camera.width * factor)),
                      static_cast<int>(std::lround(recording.camera.height * factor)));
  recording.camera = Camera(recording.camera).Resized(size.width, size.height).parameters();
  const auto interpolation = factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC;
  for (TimedImage& image : recording.images) {
    cv::Mat scaled;
    cv::resize(image.image, scaled, size, 0, 0, interpolation);
    image.image = scaled;
  }
  return recording;
}

Recording AddNoise(Recording recording, double sigma, Random& random) {
  for (TimedImage& image : recording.images) {
    cv::Mat noisy = image.image.clone();
    for (uchar& value : cv::Mat_<uchar>(noisy)) {
      value = cv::saturate_cast<uchar>(value + random.Gaussian(sigma));
    }
    image.image = noisy;
  }
  return recording;
}

}  // namespace corvo::test
