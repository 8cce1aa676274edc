// SPDX-License-Identifier: MIT
#include "bench/staged_extractor.h"

#include <utility>

#include "bench/clocks.h"
#include "orb/apportion.h"
#include "orb/level_extractor.h"
#include "orb/orientation.h"
#include "orb/pattern_file.h"

namespace corvo::bench {
namespace {

orb::ExtractorOptions WithFeatures(int num_features) {
  orb::ExtractorOptions options;
  options.num_features = num_features;
  return options;
}

}  // namespace

StagedExtractor::StagedExtractor(int num_features)
    : options_(WithFeatures(num_features)),
      pyramid_(orb::OctaveScales(options_.num_levels, options_.scale_factor)),
      detectors_(options_.num_levels),
      selectors_(options_.num_levels),
      describer_(orb::LoadPattern(options_.pattern), options_.orientation_bins, options_.upright),
      areas_(options_.num_levels),
      num_corners_(options_.num_levels),
      quotas_(options_.num_levels),
      corners_(options_.num_levels),
      chosen_(options_.num_levels),
      features_(options_.num_levels) {}

StageTimes StagedExtractor::Extract(const cv::Mat& image) {
  StageTimes times{};
  double before_ms = ThreadTimeMs();
  const auto lap_ms = [&before_ms] {
    const double now_ms = ThreadTimeMs();
    return now_ms - std::exchange(before_ms, now_ms);
  };
  pyramid_.Build(image, workers_);
  times[0] = lap_ms();
  Detect();
  times[1] = lap_ms();
  Select();
  times[2] = lap_ms();
  Orient();
  times[3] = lap_ms();
  Smooth();
  lap_ms();
  Smooth();
  times[4] = lap_ms();
  Describe();
  times[5] = lap_ms() - times[4];
  return times;
}

void StagedExtractor::Detect() {
  for (int i = 0; i < options_.num_levels; ++i) {
    const cv::Mat& image = pyramid_.levels()[i].image;
    detectors_[i].Detect(image, options_.min_fast_threshold, orb::InsideBorder(image), corners_[i]);
  }
}

void StagedExtractor::Select() {
  for (int i = 0; i < options_.num_levels; ++i) {
    areas_[i] = orb::InsideBorder(pyramid_.levels()[i].image).area();
    num_corners_[i] = static_cast<int>(corners_[i].size());
  }
  orb::Apportion(options_.num_features, areas_, num_corners_, quotas_);
  for (int i = 0; i < options_.num_levels; ++i) {
    const cv::Rect area = orb::InsideBorder(pyramid_.levels()[i].image);
    selectors_[i].Select(corners_[i], area, options_.cell_size_px, quotas_[i], chosen_[i]);
  }
}

void StagedExtractor::Orient() {
  for (int i = 0; i < options_.num_levels; ++i) {
    const orb::PyramidLevel& level = pyramid_.levels()[i];
    features_[i].keypoints.clear();
    for (const int index : chosen_[i]) {
      const orb::Corner& corner = corners_[i][index];
      features_[i].keypoints.push_back({static_cast<float>(level.InputX(corner.x)),
                                        static_cast<float>(level.InputY(corner.y)),
                                        orb::OrientationDeg(level.image, corner.x, corner.y),
                                        static_cast<float>(corner.score), i});
    }
  }
}

void StagedExtractor::Smooth() {
  for (int i = 0; i < options_.num_levels; ++i) {
    sums_.Start(pyramid_.levels()[i].image);
    for (const int index : chosen_[i]) sums_.Row(corners_[i][index].y);
  }
}

void StagedExtractor::Describe() {
  for (int i = 0; i < options_.num_levels; ++i) {
    orb::Features& features = features_[i];
    features.descriptors.clear();
    sums_.Start(pyramid_.levels()[i].image);
    for (std::size_t j = 0; j < chosen_[i].size(); ++j) {
      const orb::Corner& corner = corners_[i][chosen_[i][j]];
      features.descriptors.push_back(describer_.Describe(
          sums_.Row(corner.y) + corner.x, sums_.stride(), features.keypoints[j].angle_deg));
    }
  }
}

}  // namespace corvo::bench
