// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <opencv2/core/mat.hpp>

#include "orb/patch_sampler.h"
#include "orb/pattern.h"

namespace corvo::orb {

/// Keypoints that were each seen in two views: the sums around them, a row a position.
class TrainingSet {
 public:
  /// `capacity` keypoints take 2.9 kB each.
  explicit TrainingSet(int capacity);

  /// Appends keypoints until the set is full; `first[i]` and `second[i]` are views of the same.
  void Add(std::span<const PositionSums> first, std::span<const PositionSums> second);

  int size() const { return size_; }
  bool is_full() const { return size_ == first_.cols; }
  /// size() sums at a position, in the first or second views.
  const std::uint16_t* first(int position) const { return first_.ptr<std::uint16_t>(position); }
  const std::uint16_t* second(int position) const { return second_.ptr<std::uint16_t>(position); }

 private:
  int size_ = 0;
  cv::Mat first_;
  cv::Mat second_;
};

/// A pattern and what it was measured to be on its training set.
struct LearningResult {
  Pattern pattern;
  double max_correlation = 0;  ///< No two tests' bits correlate more, by magnitude.
  double flip_rate = 0;        ///< Share of the bits that differ between views of one keypoint.
};

/// How far the selection is.
struct SelectionProgress {
  double max_correlation = 0;  ///< That is now allowed.
  int num_chosen = 0;          ///< Tests.
  double share = 0;            ///< Of the candidates seen at this correlation.
};

inline constexpr int kMinTrainingSize = 1000;  ///< Keypoints.

/// Chooses tests among all 240,856 pairs of windows that do not overlap (Rublee et al., ICCV 2011,
/// section 4.3): in order of merit, each is taken whose bits over the first views correlate with
/// those of none chosen before by more than a threshold; where that gives fewer than kNumTests, the
/// threshold is raised from 0.2 by 0.05 and the selection begins again. The article's merit is a
/// mean bit near 1/2; here it is how well the bit tells views of one keypoint from keypoints of
/// different places,
///
///     d' = (d - f) / sqrt(d (1 - d) + f (1 - f)),    d = 2 m (1 - m),
///
/// with m the mean bit and f the share of keypoints whose bit flips between their views. The same
/// bits whatever the number of threads. Throws corvo::Error on fewer than kMinTrainingSize
/// keypoints, or where too few tests vary.
LearningResult LearnPattern(const TrainingSet& training, int threads,
                            const std::function<void(const SelectionProgress&)>& report = {});

}  // namespace corvo::orb
