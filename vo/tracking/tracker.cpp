#include "vo/tracking/tracker.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "orb/matcher.h"
#include "vo/map/landmark_alignment.h"
#include "vo/map/landmark_covariance.h"
#include "vo/map/landmark_projection.h"
#include "vo/optimization/pose_optimizer.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

/// Landmarks with the descriptor and the place to look for each.
struct LandmarkQueries {
  std::vector<LandmarkId> landmarks;
  std::vector<orb::Descriptor> descriptors;
  std::vector<orb::SearchWindow> windows;
  std::vector<orb::Keypoint> keypoints;  ///< Where each was seen before; empty if not used.
};

/// The landmarks of the frame before, where `predicted` puts them.
LandmarkQueries QueriesFromPrevious(const Map& map, const Frame& previous, const SE3& predicted,
                                    const Camera& camera, const std::vector<double>& octave_scales,
                                    double radius_px) {
  LandmarkQueries queries;
  const SE3 camera_from_world = predicted.Inverse();
  for (int k = 0; k < previous.num_keypoints(); ++k) {
    const Landmark* landmark = map.FindLandmark(map.Resolve(previous.landmarks[k]));
    if (landmark == nullptr) continue;
    const auto pixel = camera.Project(camera_from_world * landmark->in_world);
    if (!pixel || !camera.Contains(*pixel)) continue;
    const int octave = previous.keypoint(k).octave;
    const double radius = radius_px * octave_scales[octave];
    queries.landmarks.push_back(landmark->id);
    queries.descriptors.push_back(previous.descriptor(k));
    queries.keypoints.push_back(previous.keypoint(k));
    queries.windows.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y()),
                               static_cast<float>(radius), octave - 1, octave + 1});
  }
  return queries;
}

void Assign(const std::vector<orb::Match>& matches, const std::vector<LandmarkId>& landmarks,
            Frame& frame) {
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  std::set<LandmarkId> seen;
  for (const orb::Match& match : matches) {
    if (seen.insert(landmarks[match.query]).second) {
      frame.landmarks[match.train] = landmarks[match.query];
    }
  }
}

int MatchPrevious(const Map& map, const Frame& previous, const SE3& predicted, const Camera& camera,
                  const KeypointNoise& noise, const TrackerOptions& options, double radius_px,
                  Frame& frame) {
  const LandmarkQueries queries =
      QueriesFromPrevious(map, previous, predicted, camera, noise.octave_scales, radius_px);
  const std::vector<orb::Nearest> nearest = orb::FindNearestInWindows(
      queries.descriptors, queries.windows, frame.features.descriptors, frame.keypoint_index);
  const std::vector<orb::Match> unique =
      orb::KeepUnique(orb::KeepNear(nearest, options.max_distance));
  Assign(orb::KeepConsistentRotation(unique, queries.keypoints, frame.features.keypoints),
         queries.landmarks, frame);
  return CountSeenLandmarks(frame);
}

/// Pose from the frame's landmarks; those that disagree are taken from the frame.
int RefinePose(const Map& map, const SE3& initial, const Camera& camera, const KeypointNoise& noise,
               Frame& frame) {
  std::vector<int> keypoints;
  std::vector<PointObservation> observations;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] == kNoId) continue;
    const Landmark& landmark = *map.FindLandmark(frame.landmarks[k]);
    keypoints.push_back(k);
    observations.push_back({landmark.in_world, frame.pixel(k), noise.Sigma(frame, k),
                            LandmarkCovariance(map, landmark, camera, noise)});
  }
  const PoseEstimate estimate = OptimizePose(initial, observations, camera);
  frame.world_from_camera = estimate.world_from_camera;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (!estimate.is_inlier[i]) frame.landmarks[keypoints[i]] = kNoId;
  }
  return estimate.num_inliers;
}

/// Perspective-n-point with RANSAC on rays. None if it fails.
std::optional<SE3> EstimatePose(const std::vector<cv::Point3d>& in_world,
                                const std::vector<cv::Point2d>& rays, double max_ray_error) {
  constexpr int kMaxIterations = 300;
  constexpr double kConfidence = 0.999;
  if (in_world.size() < 6) return std::nullopt;
  cv::Mat rotation_vector, translation, inliers;
  if (!cv::solvePnPRansac(in_world, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(),
                          rotation_vector, translation, false, kMaxIterations,
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

/// Matches the landmarks of the frame before anywhere in the frame, without a prediction.
std::optional<SE3> LocateAnywhere(const Map& map, const Frame& previous, const Camera& camera,
                                  const KeypointNoise& noise, Frame& frame) {
  constexpr double kMaxErrorSigmas = 3;
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  std::vector<cv::Point3d> in_world;
  std::vector<cv::Point2d> rays;
  for (const orb::Match& match : MatchFrames(previous, frame)) {
    const Landmark* landmark = map.FindLandmark(map.Resolve(previous.landmarks[match.query]));
    if (landmark == nullptr) continue;
    frame.landmarks[match.train] = landmark->id;
    in_world.emplace_back(landmark->in_world.x(), landmark->in_world.y(), landmark->in_world.z());
    rays.emplace_back(frame.rays[match.train].x(), frame.rays[match.train].y());
  }
  return EstimatePose(in_world, rays, kMaxErrorSigmas * noise.sigma_px / camera.focal());
}

/// Where a frame is and what its keypoints see there.
struct Location {
  SE3 world_from_camera;
  std::vector<LandmarkId> landmarks;
  int num_inliers = 0;
};

/// The better of a search near the prediction and, where most of its matches disagree with one
/// pose, a wider one: a prediction that is off finds enough that is merely alike.
Location LocateNear(const Map& map, const Frame& previous, const SE3& predicted,
                    const Camera& camera, const KeypointNoise& noise, const TrackerOptions& options,
                    Frame& frame) {
  constexpr double kMinInlierShare = 0.5;
  Location best;
  for (const double widening : {1.0, 2.0}) {
    const double radius_px = widening * options.search_radius_px;
    const int num_matches =
        MatchPrevious(map, previous, predicted, camera, noise, options, radius_px, frame);
    if (num_matches < options.min_matches) continue;
    const int num_inliers = RefinePose(map, predicted, camera, noise, frame);
    if (num_inliers > best.num_inliers) {
      best = {frame.world_from_camera, frame.landmarks, num_inliers};
    }
    if (num_inliers >= kMinInlierShare * num_matches) break;
  }
  return best;
}

/// A first pose from the landmarks of the frame before. Returns the inliers.
int TrackPrevious(const Map& map, const Frame& previous, const SE3& predicted, const Camera& camera,
                  const KeypointNoise& noise, const TrackerOptions& options, Frame& frame) {
  Location near = LocateNear(map, previous, predicted, camera, noise, options, frame);
  if (near.num_inliers >= options.min_matches / 2) {
    frame.world_from_camera = near.world_from_camera;
    frame.landmarks = std::move(near.landmarks);
    return near.num_inliers;
  }
  const std::optional<SE3> located = LocateAnywhere(map, previous, camera, noise, frame);
  if (!located) return 0;
  return RefinePose(map, *located, camera, noise, frame);
}

/// Landmarks of the keyframes that share most with the frame, beyond those it has, in id order.
std::vector<LandmarkId> CollectLocalLandmarks(const Map& map, const Frame& frame,
                                              int max_keyframes) {
  const std::vector<LandmarkId> seen =
      map.FindSeen(FirstKeyframes(map.FindCovisible(frame), max_keyframes));
  std::vector<LandmarkId> own = frame.landmarks;
  std::sort(own.begin(), own.end());
  std::vector<LandmarkId> others;
  std::set_difference(seen.begin(), seen.end(), own.begin(), own.end(), std::back_inserter(others));
  return others;
}

/// Where each landmark should appear from the frame's pose; those that should not are left out.
LandmarkQueries QueriesFromPose(const Map& map, const std::vector<LandmarkId>& landmarks,
                                const Frame& frame, const Camera& camera,
                                const std::vector<double>& octave_scales) {
  constexpr double kFrontalCosine = 0.998;
  constexpr double kFrontalRadius = 2.5;
  constexpr double kObliqueRadius = 4.0;
  LandmarkQueries queries;
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = *map.FindLandmark(id);
    const auto view = ProjectLandmark(landmark, frame.world_from_camera, camera, octave_scales);
    if (!view) continue;
    const double radius = view->view_cosine > kFrontalCosine ? kFrontalRadius : kObliqueRadius;
    queries.landmarks.push_back(id);
    queries.descriptors.push_back(landmark.descriptor);
    queries.windows.push_back(view->Window(radius * octave_scales[view->octave], 1, 0));
  }
  return queries;
}

/// As orb::KeepDistinct, but a second nearest in another octave is the same corner seen coarser or
/// finer and does not count.
std::vector<orb::Nearest> KeepDistinctWithinOctave(const std::vector<orb::Nearest>& nearest,
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

/// Projects the landmarks of the keyframes around and adds those that match free keypoints.
std::vector<LandmarkId> MatchLocalLandmarks(const Map& map, const Camera& camera,
                                            const KeypointNoise& noise,
                                            const TrackerOptions& options, Frame& frame) {
  const LandmarkQueries queries =
      QueriesFromPose(map, CollectLocalLandmarks(map, frame, options.max_local_keyframes), frame,
                      camera, noise.octave_scales);
  const std::vector<orb::Nearest> nearest = orb::FindNearestInWindows(
      queries.descriptors, queries.windows, frame.features.descriptors, frame.keypoint_index);
  const std::vector<orb::Match> matches = orb::KeepUnique(orb::KeepNear(
      KeepDistinctWithinOctave(nearest, frame, options.max_ratio), options.max_distance));
  std::vector<LandmarkId> visible = queries.landmarks;
  for (const LandmarkId id : frame.landmarks) {
    if (id != kNoId) visible.push_back(id);
  }
  for (const orb::Match& match : matches) {
    if (frame.landmarks[match.train] == kNoId) {
      frame.landmarks[match.train] = queries.landmarks[match.query];
    }
  }
  return visible;
}

}  // namespace

TrackingResult TrackFrame(const Map& map, const Frame& previous, const SE3& predicted,
                          const Camera& camera, const KeypointNoise& noise,
                          const TrackerOptions& options, Frame& frame) {
  TrackingResult result;
  result.num_inliers = TrackPrevious(map, previous, predicted, camera, noise, options, frame);
  result.num_matches = CountSeenLandmarks(frame);
  if (result.num_inliers < options.min_matches / 2) {
    result.reason = Reason::kTooFewMatches;
    return result;
  }
  result.visible = MatchLocalLandmarks(map, camera, noise, options, frame);
  result.num_matches = CountSeenLandmarks(frame);
  AlignKeypoints(map, camera, noise.octave_scales, frame);
  result.num_inliers = RefinePose(map, frame.world_from_camera, camera, noise, frame);
  if (result.num_inliers < options.min_inliers) result.reason = Reason::kTooFewInliers;
  return result;
}

}  // namespace corvo
