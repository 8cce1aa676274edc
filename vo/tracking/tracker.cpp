// SPDX-License-Identifier: MIT
#include "vo/tracking/tracker.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "vo/map/guided_matching.h"
#include "vo/map/landmark_alignment.h"
#include "vo/tracking/chance_test.h"
#include "vo/tracking/frame_matching.h"
#include "vo/tracking/rigid_consensus.h"

namespace corvo {
namespace {

/// Returns the projections of a frame's landmarks from a pose.
std::vector<PredictedKeypoint> PredictLandmarks(const Map& map, const Frame& frame,
                                                const SE3& world_from_camera) {
  const SE3 camera_from_world = world_from_camera.Inverse();
  std::vector<PredictedKeypoint> predictions;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(map.Resolve(frame.landmarks[k]));
    if (landmark == nullptr) continue;
    const auto pixel = map.camera().Project(camera_from_world * landmark->in_world);
    if (pixel) predictions.push_back({landmark->id, k, *pixel});
  }
  return predictions;
}

/// Assigns landmarks to the matched keypoints, each landmark at most once, and none to all others.
void AssignLandmarks(const std::vector<orb::Match>& matches, const GuidedQueries& queries,
                     Frame& frame) {
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  std::set<LandmarkId> assigned;
  for (const orb::Match& match : matches) {
    const LandmarkId id = queries.ids[match.query];
    if (assigned.insert(id).second) frame.landmarks[match.train] = id;
  }
}

/// Points and the rays of one camera that observe them.
struct PointRays {
  std::vector<cv::Point3d> in_world;
  std::vector<cv::Point2d> rays;
};

/// Returns world_from_camera by perspective-n-point RANSAC (AP3P, fixed seed), or std::nullopt if
/// it fails.
std::optional<SE3> EstimatePose(const PointRays& points, double max_ray_error, int max_iterations) {
  constexpr std::size_t kMinPoints = 6;
  constexpr double kConfidence = 0.999;
  if (points.in_world.size() < kMinPoints) return std::nullopt;
  cv::Mat rotation_vector, translation, inliers;
  if (!cv::solvePnPRansac(points.in_world, points.rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(),
                          rotation_vector, translation, false, max_iterations,
                          static_cast<float>(max_ray_error), kConfidence, inliers,
                          cv::SOLVEPNP_AP3P)) {
    return std::nullopt;
  }
  Eigen::Vector3d omega, t;
  cv::cv2eigen(rotation_vector, omega);
  cv::cv2eigen(translation, t);
  if (!omega.allFinite() || !t.allFinite()) return std::nullopt;
  return SE3(SO3::Exp(omega), t).Inverse();
}

/// Returns the landmarks of the keyframes that share most with the frame, without the frame's own,
/// in ascending order.
std::vector<LandmarkId> CollectLocalLandmarks(const Map& map, const Frame& frame,
                                              int max_keyframes) {
  const std::vector<LandmarkId> local =
      map.FindObserved(FirstKeyframes(map.FindCovisible(frame), max_keyframes));
  std::vector<LandmarkId> own = frame.landmarks;
  std::sort(own.begin(), own.end());
  std::vector<LandmarkId> others;
  std::set_difference(local.begin(), local.end(), own.begin(), own.end(),
                      std::back_inserter(others));
  return others;
}

/// Whether most of the landmarks that should be visible were found: that is not by chance.
bool IsMajority(const TrackingResult& result) {
  return 2 * result.num_inliers > static_cast<int>(result.visible.size());
}

/// Sets the pose and the landmarks of a frame. Returns the number of inliers.
int SetPose(LandmarkPose pose, Frame& frame) {
  frame.world_from_camera = pose.world_from_camera;
  frame.landmarks = std::move(pose.landmarks);
  return pose.num_inliers;
}

}  // namespace

Tracker::Tracker(const OdometryOptions& options)
    : options_(options.tracker),
      matching_(options.matching),
      pose_optimizer_(options.pose_optimizer) {}

TrackingResult Tracker::Track(const Map& map, const Frame& previous,
                              const std::vector<SE3>& predictions, Frame& frame) const {
  TrackingResult result;
  result.num_inliers = TrackPrevious(map, previous, predictions, frame);
  result.num_matches = CountObservedLandmarks(frame);
  if (result.num_inliers < options_.min_first_inliers) {
    result.reason = Reason::kTooFewMatches;
    return result;
  }
  result.visible = MatchLocalLandmarks(map, frame);
  result.num_matches = CountObservedLandmarks(frame);
  AlignKeypoints(map, frame);
  LandmarkPose consensus = FindRigidConsensus(map, frame, pose_optimizer_);
  result.num_inliers = consensus.num_inliers;
  result.contradictions = FindContradictions(frame, consensus);
  SetPose(std::move(consensus), frame);
  const bool is_enough = result.num_inliers >= options_.min_inliers &&
                         (IsMajority(result) || IsBeyondChance(map, result.visible, frame,
                                                               {matching_.max_tracking_distance}));
  if (!is_enough) result.reason = Reason::kTooFewInliers;
  return result;
}

int Tracker::TrackPrevious(const Map& map, const Frame& previous,
                           const std::vector<SE3>& predictions, Frame& frame) const {
  LandmarkPose near = LocateNearPredictions(map, previous, predictions, frame);
  if (near.num_inliers >= options_.min_first_inliers) return SetPose(std::move(near), frame);
  const std::optional<SE3> located = LocateWithoutPrediction(map, previous, frame);
  if (!located) return 0;
  return SetPose(OptimizeLandmarkPose(map, frame, frame.landmarks, *located, pose_optimizer_),
                 frame);
}

LandmarkPose Tracker::LocateNearPredictions(const Map& map, const Frame& previous,
                                            const std::vector<SE3>& predictions,
                                            Frame& frame) const {
  LandmarkPose best;
  for (const double widening : {1.0, options_.widening}) {
    const double radius_px = widening * options_.search_radius_px;
    for (const SE3& predicted : predictions) {
      const int num_matches = MatchPrevious(map, previous, predicted, radius_px, frame);
      if (num_matches < options_.min_matches) continue;
      LandmarkPose pose =
          OptimizeLandmarkPose(map, frame, frame.landmarks, predicted, pose_optimizer_);
      const bool is_consistent = pose.num_inliers >= options_.min_inlier_share * num_matches;
      if (pose.num_inliers > best.num_inliers) best = std::move(pose);
      if (is_consistent) return best;
    }
  }
  return best;
}

int Tracker::MatchPrevious(const Map& map, const Frame& previous, const SE3& predicted,
                           double radius_px, Frame& frame) const {
  const GuidedQueries queries =
      QueryKeypoints(previous, PredictLandmarks(map, previous, predicted), radius_px, map.model());
  AssignLandmarks(MatchGuided(queries, frame, {matching_.max_tracking_distance}), queries, frame);
  return CountObservedLandmarks(frame);
}

std::optional<SE3> Tracker::LocateWithoutPrediction(const Map& map, const Frame& previous,
                                                    Frame& frame) const {
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  PointRays points;
  for (const orb::Match& match :
       MatchFrames(previous, frame, {matching_.max_distance, options_.max_ratio})) {
    const Landmark* landmark = map.FindLandmark(map.Resolve(previous.landmarks[match.query]));
    if (landmark == nullptr) continue;
    frame.landmarks[match.train] = landmark->id;
    const Eigen::Vector3d& in_world = landmark->in_world;
    points.in_world.emplace_back(in_world.x(), in_world.y(), in_world.z());
    points.rays.emplace_back(frame.rays[match.train].x(), frame.rays[match.train].y());
  }
  const double max_error_px = options_.pnp_max_error_sigmas * map.model().options.keypoint_sigma_px;
  return EstimatePose(points, max_error_px / map.camera().focal(), options_.pnp_max_iterations);
}

std::vector<LandmarkId> Tracker::MatchLocalLandmarks(const Map& map, Frame& frame) const {
  const GuidedQueries queries = ProjectLandmarks(
      map, CollectLocalLandmarks(map, frame, options_.max_local_keyframes), frame.world_from_camera,
      {options_.frontal_radius_px, options_.oblique_radius_px, options_.max_frontal_angle_deg});
  const std::vector<orb::Match> matches =
      MatchGuided(queries, frame,
                  {matching_.max_tracking_distance, RatioTest::kSameOctave, options_.max_ratio});
  std::vector<LandmarkId> visible = queries.ids;
  for (const LandmarkId id : frame.landmarks) {
    if (id != kNoId) visible.push_back(id);
  }
  for (const orb::Match& match : matches) {
    LandmarkId& landmark = frame.landmarks[match.train];
    if (landmark == kNoId) landmark = queries.ids[match.query];
  }
  return visible;
}

}  // namespace corvo
