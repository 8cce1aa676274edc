// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace corvo::bench {

inline constexpr double kTolerancePx = 3;  ///< Measured in the second image.

/// Keypoints and their descriptors, one row each.
struct DescribedPoints {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  int norm = 0;  ///< The cv::NormTypes for comparing descriptors.
};

/// Two sets of points of one plane and the homography between them.
struct PointPair {
  DescribedPoints first;
  DescribedPoints second;
  cv::Matx33d second_from_first;
  cv::Size first_size;  ///< Size of the first image, px.
  cv::Size second_size;
};

/// Counts of one pair of images, or sums over several. A point counts if it maps into the other
/// image. A point of the first image is repeated if a point of the second is within kTolerancePx.
/// Pairs are formed one to one, the nearest first, of points within kTolerancePx that both count. A
/// match connects a point with the nearest descriptor among all points of the other image; it is
/// correct if that point is within kTolerancePx.
struct Measures {
  int images = 0;           ///< Number of pairs of images.
  int first = 0;            ///< Number of points of the first image that count.
  int fewer = 0;            ///< The smaller of both images' numbers of points that count.
  int repeated = 0;         ///< Repeated points of `first`.
  int paired = 0;           ///< Number of pairs of points.
  int nearest_correct = 0;  ///< Correct matches of the points of `first`.
  int mutual = 0;           ///< Mutual matches of the points of `first`.
  int mutual_correct = 0;   ///< Mutual matches that are correct.

  /// Returns the share of repeated points. It is at least Precision(), because a correct match
  /// implies a repeated point.
  double Repeatability() const { return Share(repeated, first); }
  /// Returns the repeatability of Mikolajczyk et al. (IJCV 2005), with points instead of ellipses.
  double PairedRepeatability() const { return Share(paired, fewer); }
  double Precision() const { return Share(nearest_correct, first); }
  double MatchingScore() const { return Share(mutual_correct, fewer); }
  double MutualPrecision() const { return Share(mutual_correct, mutual); }

  Measures& operator+=(const Measures& other);

 private:
  static double Share(int part, int whole) {
    return whole > 0 ? static_cast<double>(part) / whole : 0.0;
  }
};

Measures Measure(const PointPair& pair);

/// Returns the share of the 32x24 equal cells of an image that have a point.
double Spread(const std::vector<cv::KeyPoint>& points, cv::Size size);

}  // namespace corvo::bench
