// SPDX-License-Identifier: MIT
#include "bench/odometry/perturbation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace corvo::bench {
namespace {

std::vector<int> SelectImages(int size, const Perturbation& perturbation) {
  std::vector<int> images;
  for (int i = perturbation.start; i < size; i += perturbation.stride) images.push_back(i);
  if (perturbation.backwards) std::reverse(images.begin(), images.end());
  return images;
}

/// Returns the poses with times `mirror - t`, in ascending order.
PoseSequence Mirror(PoseSequence poses, TimeNs mirror) {
  for (TimedPose& pose : poses) pose.time_ns = mirror - pose.time_ns;
  std::reverse(poses.begin(), poses.end());
  return poses;
}

cv::Mat AddNoise(const cv::Mat& image, double sigma, int index) {
  cv::RNG random(1 + static_cast<std::uint64_t>(index));
  cv::Mat noise(image.size(), CV_32FC1), noisy;
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  return noisy;
}

cv::Mat Compress(const cv::Mat& image, int quality) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

Perturbation StartAt(int image) {
  return {.title = fmt::format("start {}", image), .start = image};
}

}  // namespace

std::vector<Perturbation> PerturbationSet() {
  std::vector<Perturbation> set;
  for (const int start : {0, 3, 7, 13, 20}) set.push_back(StartAt(start));
  set.push_back({.title = "stride 2", .stride = 2});
  set.push_back({.title = "noise 5", .noise_sigma = 5});
  set.push_back({.title = "gain 20%", .gain_swing = 0.2});
  set.push_back({.title = "JPEG 50", .jpeg_quality = 50});
  set.push_back({.title = "backwards", .backwards = true});
  return set;
}

std::vector<Perturbation> StartFrames(int count) {
  std::vector<Perturbation> starts;
  for (int start = 0; start < count; ++start) starts.push_back(StartAt(start));
  return starts;
}

Recording Perturb(const Recording& recording, const Perturbation& perturbation) {
  const std::vector<int> images = SelectImages(recording.size(), perturbation);
  Recording perturbed = recording;
  perturbed.times.clear();
  const TimeNs mirror = recording.times.front() + recording.times.back();
  for (const int i : images) {
    perturbed.times.push_back(perturbation.backwards ? mirror - recording.times[i]
                                                     : recording.times[i]);
  }
  if (perturbation.backwards) perturbed.truth = Mirror(recording.truth, mirror);
  perturbed.image = [images, perturbation, image = recording.image](int i) {
    return Degrade(image(images[i]), perturbation, images[i]);
  };
  return perturbed;
}

cv::Mat Degrade(const cv::Mat& image, const Perturbation& perturbation, int index) {
  cv::Mat degraded = image;
  if (perturbation.gain_swing != 0) {
    const double phase = 2 * std::numbers::pi * index / 50;
    image.convertTo(degraded, CV_8U, 1 + perturbation.gain_swing * std::sin(phase));
  }
  if (perturbation.noise_sigma > 0) {
    degraded = AddNoise(degraded, perturbation.noise_sigma, index);
  }
  if (perturbation.jpeg_quality > 0) degraded = Compress(degraded, perturbation.jpeg_quality);
  return degraded;
}

}  // namespace corvo::bench
