// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/options.h"
#include "orb/patch.h"
#include "orb/types.h"

namespace corvo::orb {

/// Keypoints found elsewhere, described.
struct DescribedKeypoints {
  Features features;         ///< In the order given; with the angle they were described at.
  std::vector<int> indices;  ///< features.keypoints[i] was given as keypoint indices[i].
};

class BufferPool;
class Describer;

/// Throws corvo::Error unless `image` and `mask` are what Extractor::Extract takes.
void CheckInput(const cv::Mat& image, const cv::Mat& mask);

/// ORB features of gray images: oriented FAST keypoints spread over a grid and rotated BRIEF
/// descriptors (Rublee et al., "ORB: an efficient alternative to SIFT or SURF", ICCV 2011).
/// The same image and options give the same bits, whatever the number of threads. Several threads
/// may use one extractor at once; it keeps the buffers of as many.
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

  /// As above, into vectors whose memory is used again: with one thread, and images of one size,
  /// nothing is allocated after the first.
  void Extract(const cv::Mat& image, const cv::Mat& mask, Features& features) const;

  /// As above, and patches[i] is set to the pixels around keypoint i.
  void Extract(const cv::Mat& image, const cv::Mat& mask, Features& features,
               std::vector<Patch>& patches) const;

  /// Describes given keypoints, each at the nearest pixel of its octave's level. An angle outside
  /// [0, 360), as detectors without orientation give, is measured. Left out is what cannot be
  /// described: keypoints less than kBorder px from their level's edge, and octaves that the
  /// pyramid lacks. What Extract() returns is described the same here. Throws corvo::Error as
  /// Extract().
  DescribedKeypoints Describe(const cv::Mat& image, std::span<const Keypoint> keypoints) const;

  /// scale_factor^octave for every level: the nominal size of a level's pixel in the input image.
  const std::vector<double>& octave_scales() const { return octave_scales_; }
  const ExtractorOptions& options() const { return options_; }

 private:
  /// `patches` may be null.
  void Extract(const cv::Mat& image, const cv::Mat& mask, Features& features,
               std::vector<Patch>* patches) const;

  ExtractorOptions options_;
  int threads_;
  std::vector<double> octave_scales_;
  std::shared_ptr<const Describer> describer_;
  std::shared_ptr<BufferPool> buffers_;
};

}  // namespace corvo::orb
