// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>

#include "bench/benchmarks.h"
#include "bench/comparison.h"
#include "bench/instruction_set_choice.h"
#include "orb/error.h"
#include "orb/fast.h"

namespace corvo::bench {
namespace {

/// Detects FAST corners with non-maximum suppression and reuses its memory.
struct CorvoFast {
  int threshold;
  orb::FastDetector detector = {};
  std::vector<orb::Corner> corners = {};

  void Detect(const cv::Mat& image) {
    detector.Detect(image, threshold, cv::Rect({0, 0}, image.size()), corners);
  }
};

struct OpenCvFast {
  int threshold;
  std::vector<cv::KeyPoint> corners = {};

  void Detect(const cv::Mat& image) { cv::FAST(image, corners, threshold, true); }
};

/// Returns whether both have the same corners. Both are in row-major order.
bool AreEqual(const std::vector<orb::Corner>& corners, const std::vector<cv::KeyPoint>& others) {
  const auto is_at = [](const orb::Corner& corner, const cv::KeyPoint& other) {
    return cv::Point2f(cv::Point(corner.x, corner.y)) == other.pt;
  };
  return std::equal(corners.begin(), corners.end(), others.begin(), others.end(), is_at);
}

void CheckEqualCorners(const std::vector<cv::Mat>& images, int threshold) {
  CorvoFast corvo{threshold};
  OpenCvFast opencv{threshold};
  for (std::size_t i = 0; i < images.size(); ++i) {
    corvo.Detect(images[i]);
    opencv.Detect(images[i]);
    if (AreEqual(corvo.corners, opencv.corners)) continue;
    throw Error(
        fmt::format("FAST with threshold {} on image {}: {} corners, not the {} of cv::FAST",
                    threshold, i, corvo.corners.size(), opencv.corners.size()));
  }
}

template <typename Detector>
Work Detect(const std::vector<cv::Mat>& images, int threshold) {
  return [&images, detector = Detector{threshold}](int item) mutable {
    detector.Detect(images[item]);
    return detector.corners.size();
  };
}

Comparison AgainstFast(ImageSet& set, int threshold) {
  const auto prepare = [&set, threshold] {
    const std::vector<cv::Mat>& images = set.Images();
    CheckEqualCorners(images, threshold);
    return Contenders{Detect<CorvoFast>(images, threshold), Detect<OpenCvFast>(images, threshold),
                      set.Source()};
  };
  return {fmt::format("{}, FAST with threshold {}, against cv::FAST", set.name(), threshold),
          set.count(), 1, prepare};
}

}  // namespace

void RegisterFast(ImageSets& images, int repeats) {
  for (const std::string& instruction_set : BestAndAvx2()) {
    for (const int threshold : {20, 7}) {
      Register(AgainstFast(images.vga, threshold), instruction_set, repeats);
      Register(AgainstFast(images.kitti, threshold), instruction_set, repeats);
    }
  }
}

}  // namespace corvo::bench
