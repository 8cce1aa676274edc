#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/options.h"
#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// ORB features of grey images: oriented FAST keypoints spread over a grid and rotated BRIEF
/// descriptors (Rublee et al., "ORB: an efficient alternative to SIFT or SURF", ICCV 2011).
/// The same image and options give the same bits, whatever the number of threads.
class Extractor {
 public:
  /// `threads` (1 to 256) levels are worked on at once. Throws corvo::Error on options out of
  /// range.
  explicit Extractor(const ExtractorOptions& options = {}, int threads = 1);

  /// `image` is 8-bit, one channel. `mask` is empty or of the image's size, 8-bit: keypoints are
  /// kept where it is not zero. Returns exactly the wanted number of keypoints whenever so many
  /// corners exist, sorted by octave, then row, then column of the level. Images too small for a
  /// level have no keypoints there. Throws corvo::Error on a wrong type or size.
  Features Extract(const cv::Mat& image, const cv::Mat& mask = cv::Mat()) const;

  /// scale_factor^octave for every level: the nominal size of a level's pixel in the input image.
  const std::vector<double>& octave_scales() const { return octave_scales_; }
  const ExtractorOptions& options() const { return options_; }

 private:
  ExtractorOptions options_;
  int threads_;
  std::vector<double> octave_scales_;
  RotatedPatterns patterns_;
};

}  // namespace corvo::orb
