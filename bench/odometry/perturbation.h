// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// A change to a recording that preserves the scene.
struct Perturbation {
  std::string title = "start 0";
  int start = 0;           ///< Index of the first image.
  int stride = 1;          ///< Every stride-th image is used.
  bool backwards = false;  ///< The last image comes first.
  double noise_sigma = 0;  ///< Gaussian noise of every pixel, gray levels.
  double gain_swing = 0;   ///< Brightness is multiplied by 1 + gain_swing sin(2 pi i / 50).
  int jpeg_quality = 0;    ///< JPEG compression; none if 0.
  bool is_judged = true;   ///< If false, reported, but excluded from medians.
};

/// Returns the perturbations that an estimate should withstand: five starts, half the frame rate,
/// noise, varying exposure, compression, and reversed time.
std::vector<Perturbation> PerturbationSet();

/// Returns `count` perturbations that only begin at the images 0, 1, 2, ...
std::vector<Perturbation> StartFrames(int count);

/// Returns the recording with the images that the perturbation selects, in its order and changed by
/// it. If reversed, the timestamps and the ground truth are mirrored.
Recording Perturb(const Recording& recording, const Perturbation& perturbation);

/// Returns the image with index `index` after gain, noise and compression. Deterministic.
cv::Mat Degrade(const cv::Mat& image, const Perturbation& perturbation, int index);

}  // namespace corvo::bench
