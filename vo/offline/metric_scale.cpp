// SPDX-License-Identifier: MIT
#include "vo/offline/metric_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/offline/ground_height.h"

namespace corvo {
namespace {

using FrameScales = std::vector<std::optional<FrameScale>>;

std::vector<PassedPoint> PassAll(const CameraPath& path, int segment,
                                 const std::vector<PointInSegment>& points) {
  std::vector<PassedPoint> passed;
  for (const PointInSegment& point : points) {
    if (point.segment == segment) passed.push_back(path.Pass(point.in_world));
  }
  return passed;
}

/// Sets the scale of the posed frames of a segment: that of the last place before each.
void SetScale(const Trajectory& trajectory, int segment, const CameraPath& path,
              const std::vector<FrameScale>& of_places, MetricScale& scale) {
  std::size_t place = 0;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera || frame.segment != segment) continue;
    while (place + 1 < of_places.size() && path.places()[place + 1].frame <= frame.index) ++place;
    scale.frames[frame.index] = of_places[place];
  }
}

/// Returns the scale of a frame between or beside measurements of its segment, in order.
FrameScale Interpolate(const std::vector<ScaleMeasurement>& measurements, double frame) {
  const auto after = std::ranges::upper_bound(measurements, frame, {}, &ScaleMeasurement::frame);
  if (after == measurements.begin()) return measurements.front().scale;
  if (after == measurements.end()) return measurements.back().scale;
  const ScaleMeasurement &a = *(after - 1), &b = *after;
  const double weight = (frame - a.frame) / (b.frame - a.frame);
  return {std::pow(a.scale.meters_per_unit, 1 - weight) * std::pow(b.scale.meters_per_unit, weight),
          std::hypot((1 - weight) * a.scale.log_sigma, weight * b.scale.log_sigma)};
}

/// Returns measurements by segment, in the order of their frames.
std::map<int, std::vector<ScaleMeasurement>> BySegment(
    const std::vector<ScaleMeasurement>& measurements) {
  std::map<int, std::vector<ScaleMeasurement>> by_segment;
  for (const ScaleMeasurement& m : measurements) by_segment[m.segment].push_back(m);
  for (auto& [segment, ordered] : by_segment) {
    std::ranges::sort(ordered, {}, &ScaleMeasurement::frame);
    const auto equal = std::ranges::adjacent_find(ordered, {}, &ScaleMeasurement::frame);
    if (equal == ordered.end()) continue;
    throw Error(fmt::format("two known lengths give the scale of frame {:g}", equal->frame));
  }
  return by_segment;
}

/// Returns, by the index of the frame, the offset to add to scaled positions near it: with it, each
/// step between two frames is multiplied by the mean of their scales. It is 0 as long as the scale
/// is constant.
std::vector<Eigen::Vector3d> OffsetsOf(const Trajectory& trajectory, const MetricScale& scale) {
  struct Previous {
    double meters_per_unit = 1;
    Eigen::Vector3d position, offset;
  };
  std::vector<Eigen::Vector3d> offsets(trajectory.frames.size(), Eigen::Vector3d::Zero());
  std::map<int, Previous> by_segment;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera || !scale.frames[frame.index]) continue;
    const double meters_per_unit = scale.frames[frame.index]->meters_per_unit;
    const Eigen::Vector3d& position = frame.world_from_camera->translation();
    const auto last = by_segment.find(frame.segment);
    if (last != by_segment.end()) {
      const auto& [last_meters_per_unit, last_position, last_offset] = last->second;
      offsets[frame.index] =
          last_offset + (last_meters_per_unit - meters_per_unit) / 2 * (last_position + position);
    }
    by_segment[frame.segment] = {meters_per_unit, position, offsets[frame.index]};
  }
  return offsets;
}

/// Scales the covariance of a relative pose and adds the error of the scale, which lengthens its
/// translation: υ = R^T t ε for the relative pose [R t] and a relative error ε.
void ScaleRelativePose(const FrameScale& scale, RelativePose& pose) {
  pose.covariance = ScaleCovariance(scale.meters_per_unit, pose.covariance);
  const Eigen::Vector3d lengthening = pose.reference_from_camera.rotation().Inverse() *
                                      pose.reference_from_camera.translation() * scale.log_sigma;
  pose.covariance.topLeftCorner<3, 3>() += lengthening * lengthening.transpose();
}

/// Says where the scale of a segment comes from. Its error is the largest one of its frames.
void NameScale(ScaleSource source, const FrameScale& scale, int segment, Trajectory& trajectory) {
  const auto index = static_cast<std::size_t>(segment);
  if (trajectory.scales.size() <= index) trajectory.scales.resize(index + 1);
  SegmentScale& named = trajectory.scales[index];
  if (named.source != source) named = {source, std::nullopt};
  if (scale.log_sigma == 0) return;
  named.factor = std::max(named.factor.value_or(1), std::exp(scale.log_sigma));
}

}  // namespace

MetricScale ConstantScale(const Trajectory& trajectory, double meters_per_unit) {
  CheckPositive("meters per unit", meters_per_unit);
  MetricScale scale{FrameScales(trajectory.frames.size()), std::nullopt};
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.world_from_camera) scale.frames[frame.index] = FrameScale{meters_per_unit};
  }
  return scale;
}

MetricScale ScaleOfCameraHeight(const Trajectory& trajectory,
                                const std::vector<PointInSegment>& points, double height_m) {
  CheckPositive("camera height", height_m);
  MetricScale scale{FrameScales(trajectory.frames.size()), ScaleSource::kCameraHeight};
  for (const Segment& segment : trajectory.Segments()) {
    const CameraPath path(trajectory, segment.index);
    if (path.places().size() < 2) continue;
    const auto ground = FindGround(path, PassAll(path, segment.index, points));
    if (!ground) continue;
    std::vector<FrameScale> of_places;
    for (const GroundHeight::AtPlace& place : ground->places) {
      of_places.push_back({height_m / std::exp(place.log_height), place.sigma});
    }
    SetScale(trajectory, segment.index, path, of_places, scale);
  }
  return scale;
}

MetricScale InterpolateScale(const Trajectory& trajectory,
                             const std::vector<ScaleMeasurement>& measurements,
                             ScaleSource source) {
  const auto by_segment = BySegment(measurements);
  MetricScale scale{FrameScales(trajectory.frames.size()), source};
  for (const FrameResult& frame : trajectory.frames) {
    const auto measured = by_segment.find(frame.segment);
    if (!frame.world_from_camera || measured == by_segment.end()) continue;
    scale.frames[frame.index] = Interpolate(measured->second, frame.index);
  }
  return scale;
}

MetricTransform::MetricTransform(const Trajectory& trajectory, MetricScale scale)
    : scale_(std::move(scale)), offsets_(OffsetsOf(trajectory, scale_)) {
  for (const Segment& segment : trajectory.Segments()) {
    paths_.emplace(segment.index, CameraPath(trajectory, segment.index));
  }
}

Trajectory MetricTransform::Apply(Trajectory trajectory) const {
  for (FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera) continue;
    const SE3 pose = *frame.world_from_camera;
    frame.world_from_camera = SE3(pose.rotation(), ToMeters(frame.index, pose.translation()));
  }
  UpdateRelativePoses(trajectory);
  for (FrameResult& frame : trajectory.frames) {
    const std::optional<FrameScale>& scale_of_frame = scale_.frames[frame.index];
    if (!scale_of_frame) continue;
    if (frame.relative_pose) ScaleRelativePose(*scale_of_frame, *frame.relative_pose);
    if (scale_.source) NameScale(*scale_.source, *scale_of_frame, frame.segment, trajectory);
  }
  return trajectory;
}

std::vector<double> MetricTransform::MetersPerUnit() const {
  std::vector<double> factors;
  for (const std::optional<FrameScale>& frame : scale_.frames) {
    factors.push_back(frame ? frame->meters_per_unit : 1);
  }
  return factors;
}

Eigen::Vector3d MetricTransform::ToMeters(const PointInSegment& point) const {
  const auto path = paths_.find(point.segment);
  if (path == paths_.end() || path->second.places().empty()) return point.in_world;
  const int place = path->second.Nearest(point.in_world);
  return ToMeters(path->second.places()[place].frame, point.in_world);
}

Eigen::Vector3d MetricTransform::ToMeters(int frame, const Eigen::Vector3d& in_world) const {
  if (!scale_.frames[frame]) return in_world;
  return scale_.frames[frame]->meters_per_unit * in_world + offsets_[frame];
}

}  // namespace corvo
