#include "vo/offline/match_residuals.h"

#include "orb/matcher.h"
#include "vo/map/landmark_projection.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

void AppendResiduals(const Map& map, const Keyframe& keyframe, const Camera& camera,
                     const std::vector<double>& octave_scales, std::vector<double>& residuals) {
  constexpr int kMaxKeyframes = 10;
  constexpr double kRadiusPx = 60;
  constexpr int kMaxDistance = 65;
  std::vector<orb::Descriptor> descriptors;
  std::vector<orb::SearchWindow> windows;
  std::vector<Eigen::Vector2d> pixels;
  const std::vector<KeyframeId> around =
      FirstKeyframes(map.FindCovisible(keyframe.id), kMaxKeyframes);
  for (const LandmarkId id : map.FindSeen(around)) {
    const Landmark& landmark = *map.FindLandmark(id);
    const auto view =
        ProjectLandmark(landmark, keyframe.frame.world_from_camera, camera, octave_scales);
    if (!view) continue;
    descriptors.push_back(landmark.descriptor);
    windows.push_back(view->Window(kRadiusPx * octave_scales[view->octave], 1, 1));
    pixels.push_back(view->pixel);
  }
  const std::vector<orb::Nearest> nearest = orb::FindNearestInWindows(
      descriptors, windows, keyframe.frame.features.descriptors, keyframe.frame.keypoint_index);
  for (const orb::Match& match : orb::KeepUnique(orb::KeepNear(nearest, kMaxDistance))) {
    residuals.push_back((pixels[match.query] - keyframe.frame.pixel(match.train)).norm());
  }
}

}  // namespace

std::optional<MatchResiduals> MeasureResiduals(const Map& map, const Camera& camera,
                                               const std::vector<double>& octave_scales) {
  std::vector<double> residuals;
  for (const KeyframeId id : map.KeptKeyframes()) {
    AppendResiduals(map, map.keyframe(id), camera, octave_scales, residuals);
  }
  if (residuals.empty()) return std::nullopt;
  return MatchResiduals{static_cast<int>(residuals.size()), Median(residuals)};
}

bool IsImplausible(const MatchResiduals& residuals) {
  constexpr int kMinMatches = 100;
  constexpr double kMaxMedianPx = 2;
  return residuals.num_matches >= kMinMatches && residuals.median_px > kMaxMedianPx;
}

}  // namespace corvo
