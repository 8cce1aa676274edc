// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "bench/quality/views.h"

namespace corvo::bench {

/// An image and a function that creates or reads another view of it.
struct PairTask {
  std::string series;
  std::string image;
  double parameter = 0;    ///< Parameter within the series.
  bool in_circle = false;  ///< Only keypoints within the circle inscribed in the image take part.
  cv::Mat first;
  std::function<View()> second;
};

/// A named gray image.
struct Image {
  std::string name;
  cv::Mat image;
};

/// Returns rotations in steps of 10 degrees. Gaussian noise with sigma 0, 10 and 20 and seed 1 is
/// added to the rotated images ("rotation, sigma 10").
std::vector<PairTask> RotationTasks(const std::vector<Image>& images);

/// Returns changes of scale (0.5 to 2), blur, JPEG quality, brightness and contrast.
std::vector<PairTask> ChangeTasks(const std::vector<Image>& images);

/// Returns the pairs 1-2 to 1-6 of Oxford's sequences, one series each ("oxford graf"). Throws
/// corvo::Error if a file cannot be read.
std::vector<PairTask> OxfordTasks(const std::vector<std::string>& names);

/// Reads graf 1, boat 1, bikes 1 and the first image of 7-Scenes. Throws corvo::Error if a file
/// cannot be read.
std::vector<Image> ReadImages();

}  // namespace corvo::bench
