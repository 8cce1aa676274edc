// SPDX-License-Identifier: MIT
#include "vo/tracking/scale_monitor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vo/math/median.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

/// Frames over which the share of inliers is taken, and below which it is contested. Recordings of
/// static scenes with a right calibration stay above 0.55.
constexpr int kNumShares = 5;
constexpr double kMinInlierShare = 0.54;
/// Frames whose median speed is compared with that of the frames before them.
constexpr int kNumNewest = 3;
constexpr int kNumBefore = 10;
constexpr int kMinBefore = 5;
/// The factor that makes a change of the speed, and by which flow and speed may disagree.
constexpr double kMaxFactor = 3;
/// Noise of the flow, rad per frame: about one pixel.
constexpr double kFlowNoise = 0.002;
/// The quantile of the flow: a vehicle that covers half of the image hides slower flow.
constexpr double kFlowQuantile = 0.8;
constexpr int kMinMatches = 30;

bool DifferByFactor(double a, double b) { return std::abs(std::log(a / b)) > std::log(kMaxFactor); }

template <typename Iterator>
double MedianSpeed(Iterator begin, Iterator end) {
  std::vector<double> speeds;
  for (Iterator i = begin; i != end; ++i) speeds.push_back(i->speed);
  return Median(std::move(speeds));
}

}  // namespace

ScaleEvidence CollectScaleEvidence(const Map& map, const Frame& previous, const Frame& frame,
                                   double inlier_share) {
  const SE3 camera_from_world = frame.world_from_camera.Inverse();
  std::vector<double> depths;
  for (const LandmarkId id : frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr) depths.push_back((camera_from_world * landmark->in_world).z());
  }
  const double duration_s = static_cast<double>(frame.time_ns - previous.time_ns) * 1e-9;
  const double distance =
      (frame.world_from_camera.translation() - previous.world_from_camera.translation()).norm();
  return {inlier_share, duration_s, distance / duration_s, Median(std::move(depths))};
}

std::optional<double> MeasureParallaxFlow(const Frame& previous, const Frame& frame) {
  const SO3 now_from_previous =
      (frame.world_from_camera.Inverse() * previous.world_from_camera).rotation();
  std::vector<double> angles;
  for (const orb::Match& match : MatchFrames(previous, frame)) {
    const Eigen::Vector3d before = now_from_previous * previous.rays[match.query].homogeneous();
    const Eigen::Vector3d now = frame.rays[match.train].homogeneous();
    angles.push_back(std::atan2(before.cross(now).norm(), before.dot(now)));
  }
  const auto count = static_cast<double>(angles.size());
  if (count < kMinMatches) return std::nullopt;
  const auto quantile = angles.begin() + static_cast<std::ptrdiff_t>(kFlowQuantile * count);
  std::nth_element(angles.begin(), quantile, angles.end());
  return *quantile;
}

bool ScaleMonitor::Add(const ScaleEvidence& evidence,
                       const std::function<std::optional<double>()>& measure_flow) {
  recent_.push_back(evidence);
  if (static_cast<int>(recent_.size()) > kNumNewest + kNumBefore) recent_.pop_front();
  if (IsContested()) return true;
  const std::optional<double> depth = DepthBeforeChange();
  if (!depth) return false;
  const std::optional<double> flow = measure_flow();
  const double expected_flow = evidence.speed * evidence.duration_s / *depth;
  return !flow || DifferByFactor(*flow + kFlowNoise, expected_flow + kFlowNoise);
}

bool ScaleMonitor::IsContested() const {
  if (static_cast<int>(recent_.size()) < kNumShares) return false;
  std::vector<double> shares;
  for (auto i = recent_.end() - kNumShares; i != recent_.end(); ++i) {
    shares.push_back(i->inlier_share);
  }
  return Median(std::move(shares)) < kMinInlierShare;
}

std::optional<double> ScaleMonitor::DepthBeforeChange() const {
  if (static_cast<int>(recent_.size()) < kNumNewest + kMinBefore) return std::nullopt;
  const auto newest = recent_.end() - kNumNewest;
  std::vector<double> depths;
  for (auto i = recent_.begin(); i != newest; ++i) depths.push_back(i->depth);
  const double depth = Median(std::move(depths));
  const double noise = kFlowNoise / recent_.back().duration_s;
  const double before = MedianSpeed(recent_.begin(), newest) / depth;
  const double now = MedianSpeed(newest, recent_.end()) / depth;
  if (!(depth > 0) || !DifferByFactor(now + noise, before + noise)) return std::nullopt;
  return depth;
}

}  // namespace corvo
