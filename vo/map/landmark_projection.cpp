// SPDX-License-Identifier: MIT
#include "vo/map/landmark_projection.h"

#include <algorithm>
#include <cmath>

namespace corvo {
namespace {

/// Returns the finest octave whose scale reaches max_distance / distance: the nearer the landmark,
/// the coarser the octave.
int PredictOctave(double max_distance, double distance, const std::vector<double>& octave_scales) {
  const double scale = max_distance / distance;
  const auto found = std::lower_bound(octave_scales.begin(), octave_scales.end(), scale);
  const auto octave = std::min(found, octave_scales.end() - 1) - octave_scales.begin();
  return static_cast<int>(octave);
}

}  // namespace

orb::SearchWindow LandmarkView::Window(double radius_px, int octaves_below,
                                       int octaves_above) const {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
          static_cast<float>(radius_px), octave - octaves_below, octave + octaves_above};
}

std::optional<LandmarkView> ProjectLandmark(const Landmark& landmark, const SE3& world_from_camera,
                                            const MeasurementModel& model) {
  const double tolerance = model.options.distance_tolerance;
  const Eigen::Vector3d offset = landmark.in_world - world_from_camera.translation();
  const double distance = offset.norm();
  const double min_distance = landmark.max_distance / model.octave_scales.back();
  if (distance > landmark.max_distance * tolerance || distance * tolerance < min_distance) {
    return std::nullopt;
  }
  LandmarkView view;
  view.view_cosine = offset.dot(landmark.view_direction) / distance;
  if (view.view_cosine < model.options.min_view_cosine) return std::nullopt;
  const auto pixel = model.camera.Project(world_from_camera.rotation().Inverse() * offset);
  if (!pixel || !model.camera.Contains(*pixel)) return std::nullopt;
  view.pixel = *pixel;
  view.octave = PredictOctave(landmark.max_distance, distance, model.octave_scales);
  return view;
}

}  // namespace corvo
