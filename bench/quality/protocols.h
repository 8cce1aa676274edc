// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "bench/quality/views.h"

namespace corvo::bench {

/// An image and how to make or read another view of it.
struct PairTask {
  std::string series;
  std::string image;
  double parameter = 0;    ///< Of the series.
  bool in_circle = false;  ///< Only keypoints within the circle inscribed in the image take part.
  cv::Mat first;
  std::function<View()> second;
};

/// Named images, gray.
struct Image {
  std::string name;
  cv::Mat image;
};

/// Turns in steps of 10 degrees; N(0, sigma), sigma 0, 10 and 20 with seed 1, is added to what is
/// turned ("rotation, sigma 10").
std::vector<PairTask> RotationTasks(const std::vector<Image>& images);

/// Scale 0.5 to 2, blur, JPEG, brightness and contrast.
std::vector<PairTask> ChangeTasks(const std::vector<Image>& images);

/// Pairs 1-2 to 1-6 of Oxford's sequences, a series each ("oxford graf"). Throws corvo::Error where
/// a file cannot be read.
std::vector<PairTask> OxfordTasks(const std::vector<std::string>& names);

/// graf 1, boat 1, bikes 1 and the first of 7-Scenes. Throws corvo::Error as OxfordTasks().
std::vector<Image> ReadImages();

}  // namespace corvo::bench
