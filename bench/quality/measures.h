// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace corvo::bench {

inline constexpr double kTolerancePx = 3;  ///< In the second image.

/// Keypoints and what describes them, row by row.
struct DescribedPoints {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  int norm = 0;  ///< cv::NormTypes that compares descriptors.
};

/// Two sets of points of one plane.
struct PointPair {
  DescribedPoints first;
  DescribedPoints second;
  cv::Matx33d second_from_first;
  cv::Size first_size;  ///< Of the first image, px.
  cv::Size second_size;
};

/// Counts of one pair or, summed, of several. Points count where they map into the other image.
/// One of the first image is repeated if one of the second is within kTolerancePx. Pairs are of
/// such points too, but one to one, the nearest first. A match leads from a point to the one of
/// nearest descriptor, among all of the other image, and is correct if that is within
/// kTolerancePx.
struct Measures {
  int images = 0;           ///< Pairs of images.
  int first = 0;            ///< Points of the first image that count.
  int fewer = 0;            ///< Points of the image that has fewer that count.
  int repeated = 0;         ///< Of first.
  int paired = 0;           ///< Pairs.
  int nearest_correct = 0;  ///< Correct matches of the first image's points that count.
  int mutual = 0;           ///< Matches from these both ways.
  int mutual_correct = 0;   ///< Correct ones of them.

  /// No less than Precision(): what is found correctly is there.
  double Repeatability() const { return Share(repeated, first); }
  /// As Mikolajczyk et al. count (IJCV 2005), with points in place of ellipses.
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

/// Share of the 32x24 equal cells of an image that have a point.
double Spread(const std::vector<cv::KeyPoint>& points, cv::Size size);

}  // namespace corvo::bench
