// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>

#include "bench/benchmarks.h"
#include "bench/comparison.h"
#include "bench/instruction_set_choice.h"
#include "orb/extractor.h"

namespace corvo::bench {
namespace {

constexpr int kMaxSiftImages = 10;  ///< cv::SIFT is slow.

struct Task {
  ImageSet& images;
  int num_features;

  std::string Title() const { return fmt::format("{}, {} keypoints", images.name(), num_features); }
};

Work Corvo(const Task& task, int threads) {
  orb::ExtractorOptions options;
  options.num_features = task.num_features;
  const auto extractor = std::make_shared<orb::Extractor>(options, threads);
  return [&images = task.images.Images(), extractor, features = orb::Features()](int item) mutable {
    extractor->Extract(images[item], cv::Mat(), features);
    return features.keypoints.size();
  };
}

Work OpenCv(const Task& task, const cv::Ptr<cv::Feature2D>& features) {
  return [&images = task.images.Images(), features, keypoints = std::vector<cv::KeyPoint>(),
          descriptors = cv::Mat()](int item) mutable {
    features->detectAndCompute(images[item], cv::noArray(), keypoints, descriptors);
    return keypoints.size();
  };
}

/// Returns cv::ORB with its defaults: 8 levels at a scale factor of 1.2, FAST threshold 20.
Work OpenCvOrb(const Task& task) { return OpenCv(task, cv::ORB::create(task.num_features)); }

Work OpenCvSift(const Task& task) { return OpenCv(task, cv::SIFT::create(task.num_features)); }

Comparison AgainstOrb(const Task& task) {
  return {task.Title() + ", against cv::ORB", task.images.count(), 1, [task] {
            return Contenders{Corvo(task, 1), OpenCvOrb(task), task.images.Source()};
          }};
}

Comparison AgainstSift(const Task& task) {
  const int items = std::min(task.images.count(), kMaxSiftImages);
  return {task.Title() + ", against cv::SIFT", items, 1, [task] {
            return Contenders{Corvo(task, 1), OpenCvSift(task), task.images.Source()};
          }};
}

Comparison TwoThreadsAgainstOne(const Task& task) {
  return {task.Title() + ", two threads against one", task.images.count(), 2, [task] {
            return Contenders{Corvo(task, 2), Corvo(task, 1), task.images.Source()};
          }};
}

Comparison TwoThreadsAgainstOrb(const Task& task) {
  return {task.Title() + ", two threads, against cv::ORB with two", task.images.count(), 2, [task] {
            return Contenders{Corvo(task, 2), OpenCvOrb(task), task.images.Source()};
          }};
}

}  // namespace

void RegisterExtraction(ImageSets& images, int repeats) {
  const Task full_hd{images.full_hd, 2000};
  std::vector<Task> tasks;
  for (const int num_features : {500, 1000, 2000}) tasks.push_back({images.vga, num_features});
  for (const int num_features : {500, 1000, 2000}) tasks.push_back({images.kitti, num_features});
  tasks.push_back({images.euroc, 1000});
  tasks.push_back(full_hd);
  for (const std::string& instruction_set : BestAndAvx2()) {
    for (const Task& task : tasks) Register(AgainstOrb(task), instruction_set, repeats);
    Register(AgainstSift({images.vga, 1000}), instruction_set, repeats);
    Register(TwoThreadsAgainstOne(full_hd), instruction_set, repeats);
    Register(TwoThreadsAgainstOrb(full_hd), instruction_set, repeats);
  }
}

}  // namespace corvo::bench
