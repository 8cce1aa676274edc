// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// A change to a recording that leaves what it shows the same.
struct Perturbation {
  std::string title = "start 0";
  int start = 0;           ///< Index of the first image.
  int stride = 1;          ///< Of so many images one is used.
  bool backwards = false;  ///< The last image comes first.
  double noise_sigma = 0;  ///< Of Gaussian noise on every pixel, gray.
  double gain_swing = 0;   ///< Brightness is multiplied by 1 + gain_swing sin(2 pi i / 50).
  int jpeg_quality = 0;    ///< Compressed and decompressed again; 0: not.
  bool is_judged = true;   ///< false: reported, but in no median.
};

/// What an estimate should survive: five starts, half the frame rate, noise, a swinging exposure,
/// compression, and time reversed.
std::vector<Perturbation> PerturbationSet();

/// The images that the perturbation leaves, in its order and changed by it. Backwards, times and
/// truth are mirrored.
Recording Perturb(const Recording& recording, const Perturbation& perturbation);

/// The image with index `index` after noise, gain and compression. Deterministic.
cv::Mat Degrade(const cv::Mat& image, const Perturbation& perturbation, int index);

}  // namespace corvo::bench
