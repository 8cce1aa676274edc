// SPDX-License-Identifier: MIT
#include "orb/level_extractor.h"

#include <algorithm>
#include <cstdint>

#include "orb/harris.h"
#include "orb/kernels/directions.h"
#include "orb/orientation.h"
#include "orb/rounding.h"

namespace corvo::orb {
namespace {

/// Returns whether the mask keeps a pixel of a level. It is sampled at the nearest input pixel.
bool IsKept(const cv::Mat& mask, const PyramidLevel& level, const Corner& corner) {
  const int column = std::min(RoundHalfUp(level.InputX(corner.x)), mask.cols - 1);
  const int row = std::min(RoundHalfUp(level.InputY(corner.y)), mask.rows - 1);
  return mask.at<std::uint8_t>(row, column) != 0;
}

Keypoint MakeKeypoint(const PyramidLevel& level, int octave, const Corner& corner, float angle_deg,
                      Ranking ranking) {
  const float response = ranking == Ranking::kHarris
                             ? static_cast<float>(HarrisResponse(level.image, corner.x, corner.y))
                             : static_cast<float>(corner.score);
  return {static_cast<float>(level.InputX(corner.x)), static_cast<float>(level.InputY(corner.y)),
          angle_deg, response, octave};
}

}  // namespace

cv::Rect InsideBorder(const cv::Mat& level_image) {
  return {kBorder, kBorder, std::max(0, level_image.cols - 2 * kBorder),
          std::max(0, level_image.rows - 2 * kBorder)};
}

void LevelExtractor::Detect(const PyramidLevel& level, const cv::Mat& mask,
                            const ExtractorOptions& options) {
  detector_.Detect(level.image, options.min_fast_threshold, InsideBorder(level.image), corners_);
  if (!mask.empty()) {
    std::erase_if(corners_, [&](const Corner& corner) { return !IsKept(mask, level, corner); });
  }
  if (options.grid && options.ranking == Ranking::kHarris) {
    RankByHarris(level.image, options.fast_threshold, corners_);
  }
}

void LevelExtractor::SelectAnywhere(const cv::Mat& image, int quota,
                                    const ExtractorOptions& options) {
  if (options.ranking == Ranking::kHarris) {
    SelectStrongest(corners_, 2 * quota, chosen_);
    for (std::size_t i = 0; i < chosen_.size(); ++i) corners_[i] = corners_[chosen_[i]];
    corners_.resize(chosen_.size());
    RankByHarris(image, options.fast_threshold, corners_);
  }
  SelectStrongest(corners_, quota, chosen_);
}

void LevelExtractor::Orient(const cv::Mat& image) {
  moments_.resize(chosen_.size());
  angles_deg_.resize(chosen_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const Corner& corner = corners_[chosen_[i]];
    moments_[i] = MomentsAt(image, corner.x, corner.y);
  }
  kernels::FindDirectionsDeg(moments_, angles_deg_);
}

void LevelExtractor::Describe(const PyramidLevel& level, int octave,
                              const ExtractorOptions& options, const Describer& describer,
                              FeatureSpan features) {
  const int quota = static_cast<int>(features.keypoints.size());
  if (options.grid) {
    selector_.Select(corners_, InsideBorder(level.image), options.cell_size_px, quota, chosen_);
  } else {
    SelectAnywhere(level.image, quota, options);
  }
  Orient(level.image);
  sums_.Start(level.image);
  for (int i = 0; i < quota; ++i) {
    const Corner& corner = corners_[chosen_[i]];
    features.keypoints[i] = MakeKeypoint(level, octave, corner, angles_deg_[i], options.ranking);
    features.descriptors[i] =
        describer.Describe(sums_.Row(corner.y) + corner.x, sums_.stride(), angles_deg_[i]);
  }
}

}  // namespace corvo::orb
