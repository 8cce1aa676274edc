#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/map/frame.h"
#include "vo/offline/focal_search.h"

namespace corvo {

/// Matches features between pictures of a sequence, for SearchFocal: from first pictures spread
/// evenly over it, each with the earliest later one to which the features have moved far.
class PicturePairs {
 public:
  /// Of `num_pictures` pictures, with at most `max_pairs` first ones.
  PicturePairs(int num_pictures, int max_pairs);

  /// Whether picture `i` is looked at.
  bool Needs(int i) const;

  /// Takes picture `i`, 8-bit grey, all of one size; `mask` as orb::Extractor's. Pictures come in
  /// order, those that are not needed may be left out. Throws corvo::Error on a wrong type or size.
  void Add(int i, const cv::Mat& picture, const cv::Mat& mask = cv::Mat());

  /// Of every first picture with enough matches and motion.
  std::vector<PixelMatches> Get() const;

 private:
  struct Start {
    int picture = 0;
    Frame frame;
    PixelMatches matches;  // With the picture to which the features moved the farthest so far.
    double displacement_px = 0;  // Median.
    bool is_done = false;
  };

  void Match(const Frame& frame, double far_px, Start& start) const;

  orb::Extractor extractor_;
  std::vector<Start> starts_;
};

}  // namespace corvo
