// SPDX-License-Identifier: MIT
#include "apps/synthetic/training_pairs.h"

#include <cmath>
#include <optional>

#include "apps/synthetic/training_view.h"
#include "orb/keypoint_index.h"

namespace corvo {
namespace {

struct Prediction {
  cv::Point2d pixel;
  double scale = 1;  ///< Square root of the local change of area.
};

/// Predicts the pixel and scale of a keypoint under a homography. The change of area is the
/// determinant of the Jacobian, det(H) / w^3.
Prediction Predict(const cv::Matx33d& homography, const orb::Keypoint& keypoint) {
  const cv::Vec3d mapped = homography * cv::Vec3d(keypoint.x, keypoint.y, 1);
  const double w = mapped[2];
  const double area = std::abs(cv::determinant(homography) / (w * w * w));
  return {{mapped[0] / w, mapped[1] / w}, std::sqrt(area)};
}

/// The octaves [min, max]; empty if max < min.
struct OctaveRange {
  int min = 0;
  int max = -1;
};

/// Returns the octaves whose scale is within one level of `scale`.
OctaveRange OctavesNear(double scale, std::span<const double> octave_scales) {
  const double factor = octave_scales.size() > 1 ? octave_scales[1] : 1.0;
  OctaveRange range{static_cast<int>(octave_scales.size()), -1};
  for (int octave = 0; octave < static_cast<int>(octave_scales.size()); ++octave) {
    const double ratio = octave_scales[octave] / scale;
    if (ratio > factor || ratio * factor < 1) continue;
    range.min = std::min(range.min, octave);
    range.max = octave;
  }
  return range;
}

/// Returns the candidate nearest to a pixel within 2 px of the candidate's own level, or
/// std::nullopt if there is none.
std::optional<int> NearestOf(std::span<const int> candidates, const cv::Point2d& pixel,
                             std::span<const orb::Keypoint> keypoints,
                             std::span<const double> octave_scales) {
  constexpr double kMaxDistance = 2;
  double least = kMaxDistance * kMaxDistance;
  std::optional<int> nearest;
  for (const int i : candidates) {
    const orb::Keypoint& keypoint = keypoints[i];
    const double scale = octave_scales[keypoint.octave];
    const double dx = (keypoint.x - pixel.x) / scale;
    const double dy = (keypoint.y - pixel.y) / scale;
    if (dx * dx + dy * dy >= least) continue;
    least = dx * dx + dy * dy;
    nearest = i;
  }
  return nearest;
}

}  // namespace

KeypointPairs FindAgain(std::span<const orb::Keypoint> first, std::span<const orb::Keypoint> second,
                        const cv::Matx33d& second_from_first,
                        std::span<const double> octave_scales) {
  const orb::KeypointIndex index(second);
  KeypointPairs pairs;
  std::vector<int> candidates;
  for (const orb::Keypoint& keypoint : first) {
    const Prediction predicted = Predict(second_from_first, keypoint);
    const OctaveRange octaves =
        OctavesNear(predicted.scale * octave_scales[keypoint.octave], octave_scales);
    if (octaves.max < octaves.min) continue;
    candidates.clear();
    const double radius = 2 * octave_scales[octaves.max];
    index.Find({static_cast<float>(predicted.pixel.x), static_cast<float>(predicted.pixel.y),
                static_cast<float>(radius), octaves.min, octaves.max},
               candidates);
    const auto again = NearestOf(candidates, predicted.pixel, second, octave_scales);
    if (!again) continue;
    pairs.first.push_back(keypoint);
    pairs.second.push_back(second[*again]);
  }
  return pairs;
}

TrainingPairSampler::TrainingPairSampler(const orb::ExtractorOptions& options)
    : extractor_(options), sampler_(options) {}

TrainingPairs TrainingPairSampler::Sample(const cv::Mat& image, std::uint64_t seed) const {
  const TrainingView view = MakeTrainingView(image, seed);
  const KeypointPairs pairs =
      FindAgain(extractor_.Extract(image).keypoints, extractor_.Extract(view.image).keypoints,
                view.view_from_image, extractor_.octave_scales());
  return {sampler_.Sample(image, pairs.first), sampler_.Sample(view.image, pairs.second)};
}

}  // namespace corvo
