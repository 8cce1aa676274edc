#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/map/frame.h"
#include "vo/offline/focal_search.h"

namespace corvo {

/// Matches features between images of a sequence, for SearchFocal: from first images spread
/// evenly over it, each with the earliest later one to which the features have moved far.
class ImagePairs {
 public:
  /// Of `num_images` images, with at most `max_pairs` first ones.
  ImagePairs(int num_images, int max_pairs);

  /// Whether image `i` is looked at.
  bool Needs(int i) const;

  /// Takes image `i`, 8-bit gray, all of one size; `mask` as orb::Extractor's. Images come in
  /// order, those that are not needed may be left out. Throws corvo::Error on a wrong type or size.
  void Add(int i, const cv::Mat& image, const cv::Mat& mask = cv::Mat());

  /// Of every first image with enough matches and motion.
  std::vector<PixelMatches> Get() const;

 private:
  struct Start {
    int image = 0;
    Frame frame;
    PixelMatches matches;        // With the image to which the features moved the farthest so far.
    double displacement_px = 0;  // Median.
    bool is_done = false;
  };

  void Match(const Frame& frame, double far_px, Start& start) const;

  orb::Extractor extractor_;
  std::vector<Start> starts_;
};

}  // namespace corvo
