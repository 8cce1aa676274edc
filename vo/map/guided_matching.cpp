// SPDX-License-Identifier: MIT
#include "vo/map/guided_matching.h"

#include <cmath>
#include <numbers>

#include "vo/map/landmark_projection.h"

namespace corvo {
namespace {

/// Clears the queries whose second nearest keypoint is in the same octave as the nearest and fails
/// the ratio test.
std::vector<orb::Nearest> TestRatioWithinOctave(const std::vector<orb::Nearest>& nearest,
                                                const Frame& frame, double max_ratio) {
  std::vector<orb::Nearest> kept = nearest;
  for (orb::Nearest& candidate : kept) {
    if (candidate.index < 0 || candidate.second_index < 0) continue;
    if (frame.keypoint(candidate.index).octave != frame.keypoint(candidate.second_index).octave) {
      continue;
    }
    if (candidate.distance > max_ratio * candidate.second_distance) candidate = orb::Nearest();
  }
  return kept;
}

std::vector<orb::Nearest> TestRatio(const std::vector<orb::Nearest>& nearest, const Frame& frame,
                                    const GuidedMatchingOptions& options) {
  switch (options.ratio_test) {
    case RatioTest::kAnyOctave:
      return orb::RatioTest(nearest, options.max_ratio);
    case RatioTest::kSameOctave:
      return TestRatioWithinOctave(nearest, frame, options.max_ratio);
    case RatioTest::kNone:
      break;
  }
  return nearest;
}

}  // namespace

GuidedQueries QueryKeypoints(const Frame& frame, const std::vector<PredictedKeypoint>& predictions,
                             double radius_px, const MeasurementModel& model) {
  GuidedQueries queries;
  for (const auto& [id, k, pixel] : predictions) {
    if (!model.camera.Contains(pixel)) continue;
    const int octave = frame.keypoint(k).octave;
    queries.ids.push_back(id);
    queries.descriptors.push_back(frame.descriptor(k));
    queries.pixels.push_back(pixel);
    queries.keypoints.push_back(frame.keypoint(k));
    queries.windows.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                               static_cast<float>(radius_px * model.octave_scales[octave]),
                               octave - 1, octave + 1});
  }
  return queries;
}

GuidedQueries ProjectLandmarks(const Map& map, const std::vector<LandmarkId>& landmarks,
                               const SE3& world_from_camera, const LandmarkWindow& window) {
  const double min_frontal_cosine = std::cos(window.max_frontal_angle_deg * std::numbers::pi / 180);
  GuidedQueries queries;
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = *map.FindLandmark(id);
    const auto view = ProjectLandmark(landmark, world_from_camera, map.model());
    if (!view) continue;
    const double radius_px = view->view_cosine > min_frontal_cosine ? window.frontal_radius_px
                                                                    : window.oblique_radius_px;
    queries.ids.push_back(id);
    queries.descriptors.push_back(landmark.descriptor);
    queries.pixels.push_back(view->pixel);
    queries.windows.push_back(view->Window(radius_px * map.model().octave_scales[view->octave],
                                           window.octaves_below, window.octaves_above));
  }
  return queries;
}

std::vector<orb::Match> MatchGuided(const GuidedQueries& queries, const Frame& frame,
                                    const GuidedMatchingOptions& options) {
  const std::vector<orb::Nearest> nearest = orb::FindNearestInWindows(
      queries.descriptors, queries.windows, frame.features.descriptors, frame.keypoint_index);
  const std::vector<orb::Match> unique =
      orb::KeepUnique(orb::DistanceTest(TestRatio(nearest, frame, options), options.max_distance));
  if (queries.keypoints.empty()) return unique;
  return orb::KeepConsistentRotation(unique, queries.keypoints, frame.features.keypoints);
}

}  // namespace corvo
