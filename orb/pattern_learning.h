// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <opencv2/core/mat.hpp>

#include "orb/patch_sampler.h"
#include "orb/pattern.h"

namespace corvo::orb {

/// A set of keypoints that are each observed in two views: the window sums around them, with one
/// row for each position.
class TrainingSet {
 public:
  /// Allocates memory for `capacity` keypoints, 2.9 kB each.
  explicit TrainingSet(int capacity);

  /// Appends keypoints until the set is full; `first[i]` and `second[i]` are views of the same
  /// keypoint.
  void Add(std::span<const PositionSums> first, std::span<const PositionSums> second);

  int size() const { return size_; }
  bool is_full() const { return size_ == first_.cols; }
  /// Returns the size() sums at a position, in the first or second views.
  const std::uint16_t* first(int position) const { return first_.ptr<std::uint16_t>(position); }
  const std::uint16_t* second(int position) const { return second_.ptr<std::uint16_t>(position); }

 private:
  int size_ = 0;
  cv::Mat first_;
  cv::Mat second_;
};

/// A pattern and its statistics on the training set.
struct LearningResult {
  Pattern pattern;
  double max_correlation = 0;  ///< Bound on any two tests' correlation, magnitude.
  double flip_rate = 0;        ///< Fraction of bits that differ between views of a keypoint.
};

/// The progress of the selection.
struct SelectionProgress {
  double max_correlation = 0;  ///< The current threshold.
  int num_chosen = 0;          ///< Number of tests chosen.
  double share = 0;            ///< Fraction of the candidates processed at this threshold.
};

inline constexpr int kMinTrainingSize = 1000;  ///< Number of keypoints.

/// Chooses tests from all 240,856 pairs of windows that do not overlap (Rublee et al., ICCV 2011,
/// section 4.3). In order of merit, a test is chosen if its bits over the first views correlate
/// with those of every test chosen before by at most a threshold; if that gives fewer than
/// kNumTests, the threshold, initially 0.2, is raised by 0.05 and the selection begins again. The
/// merit in the article is a mean bit near 1/2; here it is the ability of the bit to distinguish
/// two views of one keypoint from views of different keypoints,
///
///     d' = (d - f) / sqrt(d (1 - d) + f (1 - f)),    d = 2 m (1 - m),
///
/// where m is the mean bit and f is the fraction of keypoints whose bit flips between their views.
/// The result does not depend on the number of threads. Throws corvo::Error if there are fewer than
/// kMinTrainingSize keypoints, or if too few tests vary.
LearningResult LearnPattern(const TrainingSet& training, int threads,
                            const std::function<void(const SelectionProgress&)>& report = {});

}  // namespace corvo::orb
