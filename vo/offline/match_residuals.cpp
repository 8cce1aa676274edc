// SPDX-License-Identifier: MIT
#include "vo/offline/match_residuals.h"

#include <vector>

#include "orb/options.h"
#include "vo/map/guided_matching.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

void AppendResiduals(const Map& map, const Keyframe& keyframe, const MatchResidualOptions& options,
                     std::vector<double>& residuals) {
  const std::vector<KeyframeId> around =
      FirstKeyframes(map.FindCovisible(keyframe.id), options.max_keyframes);
  const LandmarkWindow window{options.search_radius_px, options.search_radius_px, 0, 1, 1};
  const Frame& frame = keyframe.frame;
  const GuidedQueries queries =
      ProjectLandmarks(map, map.FindObserved(around), frame.world_from_camera, window);
  // Repetitive texture has matches elsewhere that say nothing about the camera.
  const GuidedMatchingOptions unique{options.max_distance, RatioTest::kSameOctave,
                                     options.max_ratio};
  for (const orb::Match& match : MatchGuided(queries, frame, unique)) {
    residuals.push_back((queries.pixels[match.query] - frame.pixel(match.train)).norm());
  }
}

}  // namespace

std::optional<MatchResiduals> MeasureResiduals(const Map& map,
                                               const MatchResidualOptions& options) {
  std::vector<double> residuals;
  for (const KeyframeId id : map.ActiveKeyframes()) {
    AppendResiduals(map, map.keyframe(id), options, residuals);
  }
  if (residuals.empty()) return std::nullopt;
  const double scale = orb::ImageScale(map.camera().width(), map.camera().height());
  return MatchResiduals{static_cast<int>(residuals.size()), Median(residuals),
                        scale * options.max_median_px};
}

bool IsImplausible(const MatchResiduals& residuals, const MatchResidualOptions& options) {
  return residuals.num_matches >= options.min_matches &&
         residuals.median_px > residuals.max_median_px;
}

}  // namespace corvo
