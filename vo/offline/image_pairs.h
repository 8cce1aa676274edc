// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/map/frame.h"
#include "vo/offline/focal_search.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {

/// Which pairs of images are matched; see ImagePairs.
struct ImagePairOptions {
  orb::ExtractorOptions extractor;
  FrameMatchingOptions matching;
  int max_pairs = 16;              // ablation
  int max_gap = 64;                // Bounds the cost of a slow camera.
  int min_matches = 100;           // ablation
  double min_displacement = 0.02;  // ablation
  double far_displacement = 0.1;   // ablation

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("max_pairs", self.max_pairs, 1, 10000, "pairs of all sequences together");
    field("max_gap", self.max_gap, 1, 10000, "largest number of images from first to second");
    field("min_matches", self.min_matches, 8, 100000, "least number of matches of a pair");
    field("min_displacement", self.min_displacement, 0.0, 1.0,
          "least median displacement of a pair's features, as a share of the image's diagonal");
    field("far_displacement", self.far_displacement, 0.0, 1.0,
          "median displacement with which the search ends, as a share of the image's diagonal");
  }

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// Matches features between images of a sequence, for SearchFocal: from first images spread
/// evenly over it, each with the earliest later one to which the features have moved far.
class ImagePairs {
 public:
  /// Pairs of `num_images` images. Throws corvo::Error on options out of range.
  explicit ImagePairs(int num_images, const ImagePairOptions& options = {});

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

  /// Whether images so far apart are matched: 1, 2, 3, 4, 6, 8, 12, 16 ... images.
  bool IsGap(int gap) const;
  void Match(const Frame& frame, double diagonal_px, Start& start) const;
  PixelMatches MatchPixels(const Frame& first, const Frame& second) const;

  ImagePairOptions options_;
  orb::Extractor extractor_;
  std::vector<Start> starts_;
};

}  // namespace corvo
