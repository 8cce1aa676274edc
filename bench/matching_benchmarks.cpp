// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/features2d.hpp>

#include "bench/benchmarks.h"
#include "bench/comparison.h"
#include "orb/error.h"
#include "orb/extractor.h"
#include "orb/kernels/instruction_sets.h"
#include "orb/matcher.h"
#include "orb/opencv.h"

namespace corvo::bench {
namespace {

constexpr int kNumFeatures = 2000;
constexpr int kMaxImages = 10;

/// The descriptors of one image in corvo's and OpenCV's format.
struct Described {
  std::vector<orb::Descriptor> corvo;
  cv::Mat opencv;
};

using DescribedImages = std::vector<Described>;

std::shared_ptr<const DescribedImages> DescribeImages(const std::vector<cv::Mat>& images,
                                                      int count) {
  orb::ExtractorOptions options;
  options.num_features = kNumFeatures;
  orb::Extractor extractor(options);
  const auto described = std::make_shared<DescribedImages>();
  for (int i = 0; i < count; ++i) {
    const std::vector<orb::Descriptor> descriptors = extractor.Extract(images[i]).descriptors;
    described->push_back({descriptors, orb::ToDescriptorMat(descriptors)});
  }
  return described;
}

/// Returns the image in which the descriptors of image `item` are searched: the next one, or the
/// first one after the last.
const Described& Next(const DescribedImages& images, std::size_t item) {
  return images[(item + 1) % images.size()];
}

std::vector<orb::Nearest> FindWithCorvo(const DescribedImages& images, std::size_t item) {
  return orb::FindNearest(images[item].corvo, Next(images, item).corvo);
}

using OpenCvMatches = std::vector<std::vector<cv::DMatch>>;

void FindWithOpenCv(const DescribedImages& images, std::size_t item, OpenCvMatches& matches) {
  matches.clear();  // knnMatch appends.
  const cv::BFMatcher matcher(cv::NORM_HAMMING);
  matcher.knnMatch(images[item].opencv, Next(images, item).opencv, matches, 2);
}

bool HasDistances(const orb::Nearest& nearest, const std::vector<cv::DMatch>& matches) {
  return matches.size() == 2 && static_cast<int>(matches[0].distance) == nearest.distance &&
         static_cast<int>(matches[1].distance) == nearest.second_distance;
}

void CheckEqualDistances(const DescribedImages& images) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::vector<orb::Nearest> nearest = FindWithCorvo(images, i);
    OpenCvMatches matches;
    FindWithOpenCv(images, i, matches);
    if (std::equal(nearest.begin(), nearest.end(), matches.begin(), matches.end(), HasDistances)) {
      continue;
    }
    throw Error("image " + std::to_string(i) + ": distances are not those of cv::BFMatcher");
  }
}

Contenders PrepareMatching(ImageSet& set, int count) {
  const auto images = DescribeImages(set.Images(), count);
  CheckEqualDistances(*images);
  const Work corvo = [images](int item) { return FindWithCorvo(*images, item).size(); };
  const Work opencv = [images, matches = OpenCvMatches()](int item) mutable {
    FindWithOpenCv(*images, item, matches);
    return matches.size();
  };
  return {corvo, opencv, set.Source()};
}

}  // namespace

void RegisterMatching(ImageSets& images, int repeats) {
  const int count = std::min(images.kitti.count(), kMaxImages);
  const Comparison comparison = {
      "2000 descriptors, two nearest of 2000, against cv::BFMatcher", count, 1,
      [&set = images.kitti, count] { return PrepareMatching(set, count); }};
  for (const std::string& instruction_set : orb::kernels::InstructionSets()) {
    Register(comparison, instruction_set, repeats);
  }
}

}  // namespace corvo::bench
