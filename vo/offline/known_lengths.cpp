// SPDX-License-Identifier: MIT
#include "vo/offline/known_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <Eigen/LU>

#include "orb/error.h"
#include "vo/geometry/triangulation.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {
namespace {

constexpr double kMaxLogSigma = 0.5;  // Of a size.

const FrameResult& PosedFrame(std::string_view name, const Trajectory& trajectory, int index) {
  const int num_frames = static_cast<int>(trajectory.frames.size());
  if (index < 0 || index >= num_frames) {
    throw Error(fmt::format("{}: frame {} is not one of 0 to {}", name, index, num_frames - 1));
  }
  const FrameResult& frame = trajectory.frames[index];
  if (frame.world_from_camera) return frame;
  throw Error(fmt::format("{}: frame {} has no pose", name, index));
}

void CheckOneSegment(std::string_view name, const FrameResult& first, const FrameResult& second) {
  if (first.segment == second.segment) return;
  throw Error(fmt::format("{}: the frames {} and {} are of different segments", name, first.index,
                          second.index));
}

/// A pixel that shows a point, with its ray.
struct PointView {
  int frame = 0;
  Eigen::Vector2d pixel;
  PosedRay ray;
};

struct MeasuredPoint {
  Eigen::Vector3d in_world;
  Eigen::Matrix3d covariance;
};

PointView ViewOf(const FrameResult& frame, const Camera& camera, const Eigen::Vector2d& pixel) {
  const auto ray = camera.Contains(pixel) ? camera.Undistort(pixel) : std::nullopt;
  if (ray) return {frame.index, pixel, {*frame.world_from_camera, *ray}};
  throw Error(fmt::format("known size: ({:g}, {:g}) in frame {} is outside the image of {}x{} px",
                          pixel.x(), pixel.y(), frame.index, camera.width(), camera.height()));
}

/// Returns the intersection of the two rays with the largest angle between them.
std::optional<Eigen::Vector3d> IntersectWidest(const std::vector<PointView>& views) {
  std::optional<Eigen::Vector3d> point;
  double widest = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double angle = RayAngle(views[i].ray, views[k].ray);
      if (!(angle > widest)) continue;
      widest = angle;
      point = Triangulate(views[i].ray, views[k].ray);
    }
  }
  return point;
}

/// Returns the equations of the squared reprojection error of a point, px. Where a camera does not
/// see the point, its cost is infinite.
NormalEquations<3> Linearize(const Camera& camera, const std::vector<PointView>& views,
                             const Eigen::Vector3d& in_world) {
  NormalEquations<3> equations;
  for (const PointView& view : views) {
    const SE3 camera_from_world = view.ray.world_from_camera.Inverse();
    Camera::Jacobian by_point;
    const auto pixel = camera.Project(camera_from_world * in_world, &by_point);
    if (!pixel) {
      equations.cost = std::numeric_limits<double>::infinity();
      return equations;
    }
    const Eigen::Matrix<double, 2, 3> by_world = by_point * camera_from_world.rotation().matrix();
    const Eigen::Vector2d error = *pixel - view.pixel;
    equations.hessian += by_world.transpose() * by_world;
    equations.gradient += by_world.transpose() * error;
    equations.cost += error.squaredNorm();
  }
  return equations;
}

void CheckAgreement(const Camera& camera, const std::vector<PointView>& views,
                    const Eigen::Vector3d& in_world) {
  for (const PointView& view : views) {
    const auto pixel = camera.Project(view.ray.world_from_camera.Inverse() * in_world);
    const double miss = (*pixel - view.pixel).norm();
    if (miss <= kMaxMissPx) continue;
    throw Error(fmt::format(
        "known size: the views do not agree: ({:g}, {:g}) in frame {} is {:.0f} px from "
        "where the others show the same point",
        view.pixel.x(), view.pixel.y(), view.frame, miss));
  }
}

/// Returns the point that views show. Its covariance is that for a standard deviation of 1 px.
MeasuredPoint MeasurePoint(const Camera& camera, const std::vector<PointView>& views) {
  constexpr int kMaxIterations = 20;
  const auto linearize = [&](const Eigen::Vector3d& p) { return Linearize(camera, views, p); };
  const auto plus = [](const Eigen::Vector3d& p, const Eigen::Vector3d& step) {
    return Eigen::Vector3d(p + step);
  };
  const auto start = IntersectWidest(views);
  if (!start || !std::isfinite(linearize(*start).cost)) {
    throw Error("known size: the rays of an end do not meet in front of the camera");
  }
  const Eigen::Vector3d point =
      MinimizeLevenbergMarquardt<3>(*start, linearize, plus, kMaxIterations).state;
  CheckAgreement(camera, views, point);
  return {point, linearize(point).hessian.inverse()};
}

}  // namespace

ScaleMeasurement MeasureScale(const Trajectory& trajectory, const KnownDistance& known) {
  constexpr std::string_view kName = "known distance";
  CheckPositive(kName, known.meters);
  const FrameResult& first = PosedFrame(kName, trajectory, known.first_frame);
  const FrameResult& second = PosedFrame(kName, trajectory, known.second_frame);
  CheckOneSegment(kName, first, second);
  const double units =
      (first.world_from_camera->translation() - second.world_from_camera->translation()).norm();
  if (units == 0) {
    throw Error(fmt::format("known distance: the camera did not move from frame {} to {}",
                            first.index, second.index));
  }
  return {first.segment, 0.5 * (first.index + second.index), {known.meters / units, 0}};
}

ScaleMeasurement MeasureScale(const Trajectory& trajectory, const Camera& camera,
                              const KnownSize& known) {
  constexpr std::string_view kName = "known size";
  CheckPositive(kName, known.meters);
  CheckPositive("known size: the standard deviation of pixels", known.pixel_sigma);
  if (known.views.size() < 2) throw Error("known size: at least two views are needed");
  std::vector<PointView> first_end, second_end;
  const FrameResult& start = PosedFrame(kName, trajectory, known.views.front().frame);
  for (const ObjectView& view : known.views) {
    const FrameResult& frame = PosedFrame(kName, trajectory, view.frame);
    CheckOneSegment(kName, start, frame);
    first_end.push_back(ViewOf(frame, camera, view.first_end_px));
    second_end.push_back(ViewOf(frame, camera, view.second_end_px));
  }
  const auto [first, last] = std::ranges::minmax_element(known.views, {}, &ObjectView::frame);
  const MeasuredPoint a = MeasurePoint(camera, first_end), b = MeasurePoint(camera, second_end);
  const Eigen::Vector3d between = a.in_world - b.in_world;
  const double units = between.norm();
  const Eigen::Vector3d along = between / units;
  const double variance = along.dot((a.covariance + b.covariance) * along);
  const double log_sigma = known.pixel_sigma * std::sqrt(variance) / units;
  if (!(log_sigma <= kMaxLogSigma)) {
    throw Error(
        "known size: the views determine it too poorly; the camera must have moved more "
        "between them, or be nearer to the object");
  }
  return {start.segment, 0.5 * (first->frame + last->frame), {known.meters / units, log_sigma}};
}

}  // namespace corvo
