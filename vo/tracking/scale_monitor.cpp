// SPDX-License-Identifier: MIT
#include "vo/tracking/scale_monitor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "vo/math/factor.h"
#include "vo/math/median.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

/// Frames over which the median share of inliers is taken, and the share below which these are few.
/// Recordings of static scenes with a right calibration stay above 0.55.
constexpr int kNumShares = 5;
constexpr double kMinInlierShare = 0.54;
/// The share of contested keypoints from which on they are much of a frame. Recordings of static
/// scenes stay below, but for 1 of 100 keyframes of blurred ones.
constexpr double kMaxContestedShare = 0.25;
/// Frames whose median speed is compared with that of the frames before them.
constexpr int kNumNewest = 3;
constexpr int kNumBefore = 10;
constexpr int kMinBefore = 5;
/// The factor that makes a change of the speed, and by which flow and speed may disagree.
constexpr double kMaxFactor = 3;
/// Noise of the flow, rad per frame: about one pixel.
constexpr double kFlowNoise = 0.002;
/// The flow is measured in cells of the image, with this number along each axis, so that an object
/// with rich texture does not count more than its area.
constexpr int kNumCells = 8;
constexpr int kMinMatches = 3;  // In a cell that counts.
constexpr int kMinCells = 8;
/// The quantile of the flow: an object that covers more than half of the image may move with the
/// camera.
constexpr double kFlowQuantile = 0.8;

template <typename Iterator>
double MedianSpeed(Iterator begin, Iterator end) {
  std::vector<double> speeds;
  for (Iterator i = begin; i != end; ++i) speeds.push_back(i->speed);
  return Median(std::move(speeds));
}

}  // namespace

ScaleEvidence CollectScaleEvidence(const Map& map, const Frame& previous, const Frame& frame,
                                   const TrackingResult& tracking) {
  const double duration_s = ToSeconds(frame.time_ns - previous.time_ns);
  const double distance =
      (frame.world_from_camera.translation() - previous.world_from_camera.translation()).norm();
  const double inlier_share = static_cast<double>(tracking.num_inliers) / tracking.num_matches;
  return {inlier_share, tracking.contested_share, duration_s, distance / duration_s,
          Median(DepthsOfLandmarks(map, frame))};
}

std::optional<double> MeasureParallaxFlow(const Frame& previous, const Frame& frame) {
  const SO3 now_from_previous =
      (frame.world_from_camera.Inverse() * previous.world_from_camera).rotation();
  std::map<std::pair<int, int>, std::vector<double>> angles;  // By cell.
  for (const orb::Match& match : MatchFrames(previous, frame)) {
    const Eigen::Vector3d before = now_from_previous * previous.rays[match.query].homogeneous();
    const Eigen::Vector3d now = frame.rays[match.train].homogeneous();
    const Eigen::Vector2d& pixel = frame.pixel(match.train);
    const int column = static_cast<int>(pixel.x() * kNumCells / frame.camera.width);
    const int row = static_cast<int>(pixel.y() * kNumCells / frame.camera.height);
    angles[{row, column}].push_back(std::atan2(before.cross(now).norm(), before.dot(now)));
  }
  std::vector<double> medians;
  for (auto& [cell, values] : angles) {
    if (static_cast<int>(values.size()) >= kMinMatches) medians.push_back(Median(values));
  }
  if (static_cast<int>(medians.size()) < kMinCells) return std::nullopt;
  const auto rank =
      static_cast<std::ptrdiff_t>(kFlowQuantile * static_cast<double>(medians.size()));
  std::nth_element(medians.begin(), medians.begin() + rank, medians.end());
  return medians[rank];
}

bool ScaleMonitor::Add(const ScaleEvidence& evidence,
                       const std::function<std::optional<double>()>& measure_flow) {
  recent_.push_back(evidence);
  if (static_cast<int>(recent_.size()) > kNumNewest + kNumBefore) recent_.pop_front();
  if (HasFewInliers() || evidence.contested_share > kMaxContestedShare) return true;
  const std::optional<double> depth = DepthBeforeChange();
  if (!depth) return false;
  const std::optional<double> flow = measure_flow();
  const double expected_flow = evidence.speed * evidence.duration_s / *depth;
  return !flow || !IsWithinFactor((*flow + kFlowNoise) / (expected_flow + kFlowNoise), kMaxFactor);
}

bool ScaleMonitor::HasFewInliers() const {
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
  if (!(depth > 0) || IsWithinFactor((now + noise) / (before + noise), kMaxFactor)) {
    return std::nullopt;
  }
  return depth;
}

}  // namespace corvo
