// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/map/frame.h"
#include "vo/offline/focal_search.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {

/// Options of ImagePairs.
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

/// Matches features between images of a sequence, for SearchFocal(). The first images of the pairs
/// are spread evenly over the sequence; each is matched with the earliest later image in which the
/// features have moved far.
class ImagePairs {
 public:
  /// Selects pairs among `num_images` images. Throws corvo::Error if an option is out of range.
  explicit ImagePairs(int num_images, const ImagePairOptions& options = {});

  /// Returns whether image `i` is needed.
  bool Needs(int i) const;

  /// Adds image `i`, which is 8-bit gray; all images have one size. `mask` is that of
  /// orb::Extractor. Images must be added in order; those that are not needed may be left out.
  /// Throws corvo::Error if the type or size is wrong.
  void Add(int i, const cv::Mat& image, const cv::Mat& mask = cv::Mat());

  /// Returns the matches of every first image with enough matches and motion.
  std::vector<PixelMatches> Get() const;

 private:
  struct Start {
    int image = 0;
    Frame frame;
    PixelMatches matches;        // Matches with the image of the largest displacement so far.
    double displacement_px = 0;  // Median displacement of `matches`.
    bool is_done = false;
  };

  /// Returns whether images with this gap are matched: 1, 2, 3, 4, 6, 8, 12, 16 ... images.
  bool IsGap(int gap) const;
  void Match(const Frame& frame, double diagonal_px, Start& start) const;
  PixelMatches MatchPixels(const Frame& first, const Frame& second) const;

  ImagePairOptions options_;
  orb::Extractor extractor_;
  std::vector<Start> starts_;
};

}  // namespace corvo
