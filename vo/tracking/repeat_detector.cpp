// SPDX-License-Identifier: MIT
#include "vo/tracking/repeat_detector.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "vo/math/median.h"

namespace corvo {
namespace {

constexpr int kMinTexturedCells = 20;         ///< Textured cells.
constexpr double kMinStillShare = 0.7;        ///< The rest may show things that move by themselves.
constexpr double kMaxCellDisplacement = 0.3;  ///< px; noise of single cells.
constexpr double kMaxMedianDisplacement = 0.1;  ///< px; far below the noise of a keypoint.

/// Displacements of cells: along the axes of the image, away from its center, and around it.
struct Displacements {
  std::vector<double> x, y, radial, tangential;

  void Add(const CellMotion& motion, const cv::Point2f& center) {
    x.push_back(motion.dx);
    y.push_back(motion.dy);
    const double radius = std::max(1.f, std::hypot(center.x, center.y));
    radial.push_back((motion.dx * center.x + motion.dy * center.y) / radius);
    tangential.push_back((motion.dy * center.x - motion.dx * center.y) / radius);
  }

  int size() const { return static_cast<int>(x.size()); }
  bool AreZero() const { return IsZero(x) && IsZero(y) && IsZero(radial) && IsZero(tangential); }

 private:
  static bool IsZero(const std::vector<double>& values) {
    return std::abs(Median(values)) < kMaxMedianDisplacement;
  }
};

bool IsRepeat(CellDisplacement& reference, const ReducedImage& image) {
  const cv::Size num_cells = reference.num_cells();
  int num_textured = 0, cell = 0;
  Displacements still;
  for (int row = 0; row < num_cells.height; ++row) {
    for (const CellMotion& motion : reference.MeasureRow(row, image)) {
      num_textured += motion.is_textured;
      if (motion.IsStill(kMaxCellDisplacement)) still.Add(motion, reference.CenterOf(cell));
      ++cell;
    }
    // Most images of a moving camera differ in so many cells that the others need no measuring.
    const int num_moved = num_textured - still.size();
    if (num_moved > (1 - kMinStillShare) * num_cells.area()) return false;
  }
  if (num_textured < kMinTexturedCells) {
    return cv::norm(reference.reference().pixels, image.pixels, cv::NORM_INF) == 0;
  }
  return still.size() >= kMinStillShare * num_textured && still.AreZero();
}

}  // namespace

bool RepeatDetector::Add(const ReducedImage& image) {
  if (reference_ && IsRepeat(*reference_, image)) return true;
  reference_.emplace(image);
  return false;
}

}  // namespace corvo
