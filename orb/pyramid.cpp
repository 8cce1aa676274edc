// SPDX-License-Identifier: MIT
#include "orb/pyramid.h"

#include <algorithm>

#include "orb/rounding.h"
#include "orb/workers.h"

namespace corvo::orb {
namespace {

int LevelLength(int input_length, double scale) {
  return std::max(1, RoundHalfUp(input_length / scale));
}

}  // namespace

std::vector<double> OctaveScales(int num_levels, double factor) {
  std::vector<double> scales(num_levels, 1.0);
  for (int level = 1; level < num_levels; ++level) scales[level] = scales[level - 1] * factor;
  return scales;
}

void Pyramid::LayOut(cv::Size size) {
  input_size_ = size;
  levels_.clear();
  resizers_.clear();
  cv::Size from = size;
  for (const double scale : scales_) {
    const cv::Size level_size(LevelLength(size.width, scale), LevelLength(size.height, scale));
    if (!levels_.empty()) resizers_.emplace_back(from, level_size);
    from = level_size;
    levels_.push_back({levels_.empty() ? cv::Mat() : cv::Mat(level_size, CV_8UC1),
                       static_cast<double>(size.width) / level_size.width,
                       static_cast<double>(size.height) / level_size.height});
  }
}

void Pyramid::ResizeLevel(int i, Workers& workers) {
  constexpr int kMinBandArea = 1 << 15;
  const cv::Size size = resizers_[i].to();
  const int num_bands = std::clamp(size.area() / kMinBandArea, 1, workers.count());
  workers.ForEach(num_bands, [&](int band) {
    resizers_[i].ResizeRows(levels_[i].image, size.height * band / num_bands,
                            size.height * (band + 1) / num_bands, row_caches_[band],
                            levels_[i + 1].image);
  });
}

void Pyramid::Build(const cv::Mat& image, Workers& workers) {
  if (image.size() != input_size_) LayOut(image.size());
  levels_.front().image = image;
  row_caches_.resize(workers.count());
  for (int i = 0; i < static_cast<int>(resizers_.size()); ++i) ResizeLevel(i, workers);
}

std::vector<PyramidLevel> BuildPyramid(const cv::Mat& image, const std::vector<double>& scales) {
  Workers workers(1);
  Pyramid pyramid(scales);
  pyramid.Build(image, workers);
  return pyramid.levels();
}

}  // namespace corvo::orb
