// SPDX-License-Identifier: MIT
#include "bench/quality/contenders.h"

#include <algorithm>
#include <numeric>

#include "orb/opencv.h"

namespace corvo::bench {
namespace {

orb::ExtractorOptions Grid(int num_features) {
  orb::ExtractorOptions options;
  options.num_features = num_features;
  return options;
}

orb::ExtractorOptions Global(int num_features) {
  orb::ExtractorOptions options = Grid(num_features);
  options.grid = false;
  options.ranking = orb::Ranking::kHarris;
  options.orientation_bins = 256;
  return options;
}

orb::ExtractorOptions Upright(int num_features) {
  orb::ExtractorOptions options = Grid(num_features);
  options.upright = true;
  return options;
}

/// Returns the octave of a keypoint, where cv::SIFT also packs the layer and the sub-pixel offset.
int OctaveOf(const cv::KeyPoint& point) {
  if (point.octave < 256) return point.octave;
  const int octave = point.octave & 255;
  return octave < 128 ? octave : octave - 256;
}

}  // namespace

std::vector<Contender> MakeContenders(int num_features) {
  return {{"corvo, grid", orb::CreateFeature2D(Grid(num_features))},
          {"corvo, global", orb::CreateFeature2D(Global(num_features))},
          {"corvo, upright", orb::CreateFeature2D(Upright(num_features))},
          {"cv::ORB", cv::ORB::create(num_features)},
          {"cv::SIFT", cv::SIFT::create(num_features)},
          {"cv::BRISK", cv::BRISK::create()},
          {"cv::AKAZE", cv::AKAZE::create()}};
}

DescribedPoints Describe(const Contender& contender, const cv::Mat& image, int num_features) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  contender.features->detectAndCompute(image, cv::noArray(), points, descriptors);
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (static_cast<int>(points.size()) > num_features) {
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return points[a].response > points[b].response; });
    order.resize(num_features);
  }
  DescribedPoints described;
  described.norm = contender.features->defaultNorm();
  for (const int i : order) {
    described.points.push_back(points[i]);
    described.points.back().octave = OctaveOf(points[i]);
    described.descriptors.push_back(descriptors.row(i));
  }
  return described;
}

}  // namespace corvo::bench
