// SPDX-License-Identifier: MIT
#include "apps/export/point_selection.h"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "vo/camera/camera.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

/// What the images say about a point.
struct PointEvidence {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();      ///< Of its position in the world.
  Eigen::Vector3d view_directions = Eigen::Vector3d::Zero();  ///< Sum of unit vectors, world.
  std::vector<double> depths;

  /// Returns the standard deviation of the depth relative to it; infinity if it is unknown.
  double RelativeDepthSigma() const {
    const Eigen::LDLT<Eigen::Matrix3d> solver(information);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return INFINITY;
    const Eigen::Vector3d direction = view_directions.normalized();
    const double variance = direction.dot(solver.solve(direction));
    return variance > 0 ? std::sqrt(variance) / Median(depths) : INFINITY;
  }
};

/// A camera at its place.
struct PosedCamera {
  const Camera& camera;
  SE3 camera_from_world;
};

/// Adds an observation to the evidence. Returns whether the error is small enough to do so.
bool AddEvidence(const PosedCamera& posed, const Eigen::Vector3d& in_world,
                 const PointObservation& observation, double max_error_sigmas,
                 PointEvidence& evidence) {
  const auto& [camera, camera_from_world] = posed;
  Camera::Jacobian pixel_by_point;
  const Eigen::Vector3d in_camera = camera_from_world * in_world;
  const auto pixel = camera.Project(in_camera, &pixel_by_point);
  if (!pixel) return false;
  if ((*pixel - observation.pixel).norm() > max_error_sigmas * observation.sigma_px) return false;
  const Eigen::Matrix<double, 2, 3> j =
      pixel_by_point * camera_from_world.rotation().matrix() / observation.sigma_px;
  evidence.information += j.transpose() * j;
  evidence.view_directions += camera_from_world.rotation().Inverse() * in_camera.normalized();
  evidence.depths.push_back(in_camera.z());
  return true;
}

/// Removes inconsistent observations and returns the evidence of the others, one per point.
std::vector<PointEvidence> CollectEvidence(double max_error_sigmas,
                                           Reconstruction& reconstruction) {
  const Camera camera(reconstruction.camera);
  std::vector<PointEvidence> evidence(reconstruction.points.size());
  for (ReconstructedImage& image : reconstruction.images) {
    const PosedCamera posed{camera, image.world_from_camera.Inverse()};
    std::erase_if(image.observations, [&](const PointObservation& o) {
      return !AddEvidence(posed, reconstruction.points[o.point].in_world, o, max_error_sigmas,
                          evidence[o.point]);
    });
  }
  return evidence;
}

}  // namespace

void SelectPoints(const PointSelectionOptions& options, Reconstruction& reconstruction) {
  const std::vector<PointEvidence> evidence =
      CollectEvidence(options.max_error_sigmas, reconstruction);
  std::vector<int> new_index(reconstruction.points.size(), kNoId);
  std::vector<ReconstructedPoint> selected;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (static_cast<int>(evidence[i].depths.size()) < options.min_keyframes) continue;
    if (!(evidence[i].RelativeDepthSigma() <= options.max_relative_depth_sigma)) continue;
    new_index[i] = static_cast<int>(selected.size());
    selected.push_back(reconstruction.points[i]);
  }
  reconstruction.points = std::move(selected);
  for (ReconstructedImage& image : reconstruction.images) {
    std::erase_if(image.observations,
                  [&](const PointObservation& o) { return new_index[o.point] == kNoId; });
    for (PointObservation& o : image.observations) o.point = new_index[o.point];
  }
}

}  // namespace corvo
