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

/// The descriptors of keypoints that the caller supplied.
struct DescribedKeypoints {
  Features features;         ///< In input order, with the angles used for the descriptors.
  std::vector<int> indices;  ///< features.keypoints[i] is input keypoint indices[i].
};

class BufferPool;
class Describer;

/// Throws corvo::Error unless `image` and `mask` are what Extractor::Extract takes.
void CheckInput(const cv::Mat& image, const cv::Mat& mask);

/// Extracts ORB features from gray images: oriented FAST keypoints spread over a grid and rotated
/// BRIEF descriptors (Rublee et al., "ORB: an efficient alternative to SIFT or SURF", ICCV 2011).
/// The same image and options give bit-identical features; the number of threads does not matter.
/// Thread-safe: one extractor may be used by several threads at once; it keeps one set of buffers
/// for each concurrent call.
class Extractor {
 public:
  /// Processes up to `threads` (1 to 256) pyramid levels in parallel. Throws corvo::Error if an
  /// option or `threads` is out of range.
  explicit Extractor(const ExtractorOptions& options = {}, int threads = 1);

  /// Detects and describes keypoints. `image` is 8-bit, one channel. `mask` is empty, or 8-bit and
  /// of the size of `image`; keypoints are detected only where it is nonzero. Returns exactly the
  /// requested number of keypoints if there are enough corners, sorted by octave, then row, then
  /// column of the level. A level that is too small has no keypoints. Throws corvo::Error if the
  /// type or size of an input is wrong.
  Features Extract(const cv::Mat& image, const cv::Mat& mask = cv::Mat()) const;

  /// Like Extract() above, but reuses the memory of `features`: with one thread and images of one
  /// size, nothing is allocated after the first call.
  void Extract(const cv::Mat& image, const cv::Mat& mask, Features& features) const;

  /// Like Extract() above, and sets patches[i] to the pixels around keypoint i.
  void Extract(const cv::Mat& image, const cv::Mat& mask, Features& features,
               std::vector<Patch>& patches) const;

  /// Describes the given keypoints, each at the nearest pixel of its octave's level. Measures any
  /// angle outside [0, 360), the value that detectors without orientation set. Omits the keypoints
  /// that are less than kBorder px from their level's edges or whose octave is not in the pyramid.
  /// Gives the keypoints returned by Extract() the same descriptors. Throws corvo::Error under the
  /// same conditions as Extract().
  DescribedKeypoints Describe(const cv::Mat& image, std::span<const Keypoint> keypoints) const;

  /// Returns scale_factor^octave for every level: the nominal size of a level's pixel in the input
  /// image.
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
