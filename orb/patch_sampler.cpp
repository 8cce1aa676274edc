// SPDX-License-Identifier: MIT
#include "orb/patch_sampler.h"

#include <algorithm>

#include "orb/pyramid.h"
#include "orb/rounding.h"
#include "orb/window_sums.h"

namespace corvo::orb {
namespace {

/// Reads the window sums of a level at offsets from (x, y).
PositionSums Read(const cv::Mat& sums, int x, int y, std::span<const Offset> offsets) {
  PositionSums read;
  std::transform(offsets.begin(), offsets.end(), read.begin(), [&](const Offset& offset) {
    return sums.at<std::uint16_t>(y + offset.y, x + offset.x);
  });
  return read;
}

}  // namespace

Offset PositionAt(int position) {
  constexpr int kSide = 2 * kMaxOffset + 1;
  return {static_cast<std::int8_t>(position % kSide - kMaxOffset),
          static_cast<std::int8_t>(position / kSide - kMaxOffset)};
}

PatchSampler::PatchSampler(const ExtractorOptions& options)
    : upright_(options.upright),
      octave_scales_(OctaveScales(options.num_levels, options.scale_factor)),
      offsets_(options.orientation_bins) {
  for (int bin = 0; bin < options.orientation_bins; ++bin) {
    const Direction direction = DirectionOf(bin, options.orientation_bins);
    for (int i = 0; i < kNumPositions; ++i) offsets_[bin][i] = Rotate(PositionAt(i), direction);
  }
}

std::vector<PositionSums> PatchSampler::Sample(const cv::Mat& image,
                                               std::span<const Keypoint> keypoints) const {
  const std::vector<PyramidLevel> levels = BuildPyramid(image, octave_scales_);
  std::vector<cv::Mat> level_sums;
  for (const PyramidLevel& level : levels) level_sums.push_back(WindowSums(level.image));
  const int bins = static_cast<int>(std::ssize(offsets_));
  std::vector<PositionSums> sums;
  sums.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) {
    const PyramidLevel& level = levels[keypoint.octave];
    const int bin = upright_ ? 0 : NearestBin(keypoint.angle_deg, bins);
    sums.push_back(Read(level_sums[keypoint.octave], RoundHalfUp(level.LevelX(keypoint.x)),
                        RoundHalfUp(level.LevelY(keypoint.y)), offsets_[bin]));
  }
  return sums;
}

}  // namespace corvo::orb
