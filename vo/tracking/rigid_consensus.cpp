// SPDX-License-Identifier: MIT
#include "vo/tracking/rigid_consensus.h"

#include <cstddef>
#include <utility>

namespace corvo {
namespace {

/// The share of inliers below which a second motion may compete with that of the scene.
constexpr double kMinRigidShare = 0.8;
/// The least number of frames in which an established landmark was found.
constexpr int kMinFound = 6;
/// The least share of the frames that should have seen it in which it was found.
constexpr double kMinFoundShare = 0.6;
/// The least number of established landmarks that determine a pose.
constexpr int kMinEstablished = 20;
/// The least share of the established landmarks on whose motion the pose of all landmarks agrees
/// with that of the established ones.
constexpr double kMinAgreement = 0.9;

bool HasConflict(int num_inliers, int num_matches) {
  return num_inliers < kMinRigidShare * num_matches;
}

bool IsEstablished(const Landmark& landmark) {
  return landmark.num_found >= kMinFound &&
         landmark.num_found >= kMinFoundShare * landmark.num_visible;
}

/// Returns the landmarks with kNoId in place of those that are not established.
std::vector<LandmarkId> SelectEstablished(const Map& map, std::vector<LandmarkId> landmarks) {
  for (LandmarkId& id : landmarks) {
    if (id != kNoId && !IsEstablished(*map.FindLandmark(id))) id = kNoId;
  }
  return landmarks;
}

int CountCommon(const std::vector<LandmarkId>& a, const std::vector<LandmarkId>& b) {
  int count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != kNoId && a[k] == b[k];
  return count;
}

}  // namespace

LandmarkPose FindRigidConsensus(const Map& map, const Frame& frame,
                                const PoseOptimizerOptions& options) {
  const SE3& initial = frame.world_from_camera;
  LandmarkPose of_all = OptimizeLandmarkPose(map, frame, frame.landmarks, initial, options);
  if (!HasConflict(of_all.num_inliers, CountObservedLandmarks(frame))) return of_all;
  const std::vector<LandmarkId> established = SelectEstablished(map, frame.landmarks);
  const int num_established = CountLandmarks(established);
  if (num_established < kMinEstablished) return of_all;
  const LandmarkPose past = OptimizeLandmarkPose(map, frame, established, initial, options);
  const bool is_pose =
      past.num_inliers >= kMinEstablished && 2 * past.num_inliers > num_established;
  const int num_common = CountCommon(of_all.landmarks, past.landmarks);
  if (!is_pose || num_common >= kMinAgreement * past.num_inliers) return of_all;
  return SelectInliers(map, frame, frame.landmarks, past.world_from_camera);
}

std::vector<int> FindContradictions(const Frame& frame, const LandmarkPose& consensus) {
  std::vector<int> contradictions;
  if (!HasConflict(consensus.num_inliers, CountObservedLandmarks(frame))) return contradictions;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const bool is_outlier = frame.landmarks[k] != kNoId && consensus.landmarks[k] == kNoId;
    if (is_outlier) contradictions.push_back(k);
  }
  return contradictions;
}

}  // namespace corvo
