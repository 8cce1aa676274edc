// SPDX-License-Identifier: MIT
#include "vo/offline/camera_path.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "vo/math/median.h"

namespace corvo {
namespace {

std::vector<const FrameResult*> PosedFramesOf(const Trajectory& trajectory, int segment) {
  std::vector<const FrameResult*> frames;
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.world_from_camera && frame.segment == segment) frames.push_back(&frame);
  }
  return frames;
}

/// Returns the median distance between consecutive frames between which the camera moved.
double MedianStep(const std::vector<const FrameResult*>& frames) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double step = (frames[i]->world_from_camera->translation() -
                         frames[i - 1]->world_from_camera->translation())
                            .norm();
    if (step > 0) steps.push_back(step);
  }
  return Median(std::move(steps));
}

}  // namespace

CameraPath::CameraPath(const Trajectory& trajectory, int segment) {
  AddPlaces(trajectory, segment);
  FindDirections();
  FindStretches();
}

void CameraPath::AddPlaces(const Trajectory& trajectory, int segment) {
  const std::vector<const FrameResult*> frames = PosedFramesOf(trajectory, segment);
  const double min_step = 0.5 * MedianStep(frames);
  for (const FrameResult* frame : frames) {
    Place place;
    place.frame = frame->index;
    place.world_from_camera = *frame->world_from_camera;
    if (!places_.empty()) {
      const double step =
          (place.world_from_camera.translation() - places_.back().world_from_camera.translation())
              .norm();
      if (step < min_step || step == 0) continue;
      place.distance = places_.back().distance + step;
    }
    places_.push_back(place);
  }
}

void CameraPath::FindDirections() {
  constexpr int kReach = 2;
  const int last = static_cast<int>(places_.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    Place& place = places_[i];
    const SE3& behind = places_[std::max(0, i - kReach)].world_from_camera;
    const SE3& ahead = places_[std::min(last, i + kReach)].world_from_camera;
    place.forward = (ahead.translation() - behind.translation()).normalized();
    const Eigen::Vector3d down = place.world_from_camera.rotation() * Eigen::Vector3d::UnitY();
    place.down = (down - down.dot(place.forward) * place.forward).normalized();
    place.right = place.down.cross(place.forward);
  }
}

void CameraPath::FindStretches() {
  constexpr int kPlaces = 32;
  const int size = static_cast<int>(places_.size());
  for (int first = 0; first < size; first += kPlaces) {
    Stretch stretch{first, std::min(first + kPlaces, size)};
    stretch.center = places_[(first + stretch.last) / 2].world_from_camera.translation();
    for (int i = first; i < stretch.last; ++i) {
      const Eigen::Vector3d& position = places_[i].world_from_camera.translation();
      stretch.radius = std::max(stretch.radius, (position - stretch.center).norm());
    }
    stretches_.push_back(stretch);
  }
}

int CameraPath::Nearest(const Eigen::Vector3d& in_world) const {
  double least = std::numeric_limits<double>::infinity();
  int nearest = 0;
  for (const Stretch& stretch : stretches_) {
    if ((in_world - stretch.center).norm() - stretch.radius > least) continue;
    for (int i = stretch.first; i < stretch.last; ++i) {
      const double distance = (in_world - places_[i].world_from_camera.translation()).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

PassedPoint CameraPath::Pass(const Eigen::Vector3d& in_world) const {
  PassedPoint passed;
  passed.place = Nearest(in_world);
  const Place& place = places_[passed.place];
  const Eigen::Vector3d offset = in_world - place.world_from_camera.translation();
  passed.right = place.right.dot(offset);
  passed.below = place.down.dot(offset);
  passed.beyond = place.forward.dot(offset);
  return passed;
}

}  // namespace corvo
