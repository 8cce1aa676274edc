// SPDX-License-Identifier: MIT
#include "vo/offline/match_residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "orb/options.h"
#include "vo/map/guided_matching.h"
#include "vo/offline/map_camera.h"

namespace corvo {
namespace {

/// The distance of a match from its projection, and the radius within which it was searched; px.
struct Residual {
  double distance_px = 0;
  double radius_px = 0;
};

std::vector<Residual> ResidualsOf(const Map& map, const Keyframe& keyframe,
                                  const MatchResidualOptions& options) {
  const std::vector<KeyframeId> around =
      FirstKeyframes(map.FindCovisible(keyframe.id), options.max_keyframes);
  const LandmarkWindow window{options.search_radius_px, options.search_radius_px, 0, 1, 1};
  const Frame& frame = keyframe.frame;
  const GuidedQueries queries =
      ProjectLandmarks(map, map.FindObserved(around), frame.world_from_camera, window);
  // Repetitive texture has matches elsewhere that say nothing about the camera.
  const GuidedMatchingOptions unique{options.max_distance, RatioTest::kSameOctave,
                                     options.max_ratio};
  std::vector<Residual> residuals;
  for (const orb::Match& match : MatchGuided(queries, frame, unique)) {
    residuals.push_back({(queries.pixels[match.query] - frame.pixel(match.train)).norm(),
                         queries.windows[match.query].radius});
  }
  return residuals;
}

/// Returns the median distance of the matches, at least one, that are not due to chance. Matches by
/// chance are spread evenly over the search windows, of which the outer half of the area has few
/// others.
double MedianWithoutChance(std::vector<Residual> residuals) {
  std::sort(residuals.begin(), residuals.end(),
            [](const Residual& a, const Residual& b) { return a.distance_px < b.distance_px; });
  double num_outer = 0;
  std::map<double, int> windows;
  for (const Residual& residual : residuals) {
    num_outer += 2 * std::pow(residual.distance_px / residual.radius_px, 2) > 1;
    ++windows[residual.radius_px];
  }
  const auto size = static_cast<double>(residuals.size());
  const double chance = std::min(1.0, 2 * num_outer / size);
  double num_within = 0;
  for (const Residual& residual : residuals) {
    double area = 0;  // The part of the windows within this distance, in windows.
    for (const auto& [radius_px, count] : windows) {
      area += count * std::min(1.0, std::pow(residual.distance_px / radius_px, 2));
    }
    if (++num_within - chance * area >= 0.5 * (1 - chance) * size) return residual.distance_px;
  }
  return residuals.back().distance_px;
}

}  // namespace

std::optional<MatchResiduals> MeasureResiduals(const Map& map,
                                               const MatchResidualOptions& options) {
  std::vector<Residual> all;
  MatchResiduals measured;
  measured.least_part_px = std::numeric_limits<double>::infinity();
  for (const KeyframeGroup& part : SplitKeyframes(map, options.num_parts, 1)) {
    std::vector<Residual> residuals;
    for (const KeyframeId id : part) {
      const std::vector<Residual> own = ResidualsOf(map, map.keyframe(id), options);
      residuals.insert(residuals.end(), own.begin(), own.end());
    }
    if (residuals.empty()) continue;
    all.insert(all.end(), residuals.begin(), residuals.end());
    measured.least_part_px =
        std::min(measured.least_part_px, MedianWithoutChance(std::move(residuals)));
  }
  if (all.empty()) return std::nullopt;
  const double scale = orb::ImageScale(map.camera().width(), map.camera().height());
  measured.num_matches = static_cast<int>(all.size());
  measured.median_px = MedianWithoutChance(std::move(all));
  measured.max_median_px = scale * options.max_median_px;
  return measured;
}

bool IsImplausible(const MatchResiduals& residuals, const MatchResidualOptions& options) {
  return residuals.num_matches >= options.min_matches &&
         residuals.least_part_px > residuals.max_median_px;
}

}  // namespace corvo
