// SPDX-License-Identifier: MIT
// A small tracker of single stages: track_by_stages CAMERA.yaml IMAGE...
// The first pair of images with enough parallax gives a map, in which all other images are located.
#include <cstdlib>
#include <iostream>
#include <optional>
#include <vector>

#include <corvo/orb/extractor.h>
#include <corvo/orb/matcher.h>
#include <corvo/vo/camera/camera.h>
#include <corvo/vo/geometry/two_view.h>
#include <corvo/vo/io/config.h>
#include <corvo/vo/optimization/pose_optimizer.h>
#include <opencv2/imgcodecs.hpp>

namespace {

using corvo::orb::Features;
using corvo::orb::Keypoint;
using corvo::orb::Match;

constexpr double kSigmaPx = 1;  // Of a keypoint of the finest level.

/// The points seen by a reference image: point i belongs to keypoint `keypoints[i]`.
struct PointMap {
  std::vector<corvo::KnownPoint> points;
  Features features;  ///< Of the keypoints, in the order of the points.
};

std::vector<Match> MatchMutually(const Features& first, const Features& second) {
  const auto forward = corvo::orb::FindNearest(first.descriptors, second.descriptors);
  const auto backward = corvo::orb::FindNearest(second.descriptors, first.descriptors);
  const auto distinct = corvo::orb::RatioTest(forward, 0.8);
  return corvo::orb::CrossCheck(corvo::orb::DistanceTest(distinct, 65), backward);
}

/// Returns the points that two images see, or std::nullopt if the motion between them is too small.
std::optional<PointMap> Triangulate(const Features& first, const Features& second,
                                    const corvo::Camera& camera) {
  std::vector<corvo::RayMatch> rays;
  std::vector<int> queries;
  for (const Match& match : MatchMutually(first, second)) {
    const Keypoint& a = first.keypoints[match.query];
    const Keypoint& b = second.keypoints[match.train];
    const auto ray_a = camera.Undistort({a.x, a.y});
    const auto ray_b = camera.Undistort({b.x, b.y});
    if (!ray_a || !ray_b) continue;
    rays.push_back({*ray_a, *ray_b, kSigmaPx / camera.focal()});
    queries.push_back(match.query);
  }
  const corvo::TwoViewResult motion = corvo::EstimateTwoViewMotion(rays, {});
  if (motion.reason != corvo::Reason::kNone) return std::nullopt;
  PointMap map;
  for (const corvo::TwoViewPoint& point : motion.points) {
    map.points.push_back({point.in_first});
    map.features.keypoints.push_back(first.keypoints[queries[point.match]]);
    map.features.descriptors.push_back(first.descriptors[queries[point.match]]);
  }
  return map;
}

/// Returns the pose of an image in the map, from the pose of the previous one.
corvo::PoseEstimate Locate(const Features& features, const PointMap& map, const corvo::SE3& initial,
                           const corvo::Camera& camera) {
  corvo::PoseObservations observations;
  for (const Match& match : MatchMutually(map.features, features)) {
    const Keypoint& keypoint = features.keypoints[match.train];
    corvo::Observation observation;
    observation.pixel = {keypoint.x, keypoint.y};
    observation.sigma_px = kSigmaPx;
    observations.Add(map.points[match.query], observation);
  }
  return corvo::OptimizePose(initial, observations, camera);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: track_by_stages CAMERA.yaml IMAGE...\n";
    return EXIT_FAILURE;
  }
  const corvo::Camera camera = corvo::ReadCameraFile(argv[1]).camera;
  const corvo::orb::Extractor extractor;
  const Features first = extractor.Extract(cv::imread(argv[2], cv::IMREAD_GRAYSCALE));
  std::optional<PointMap> map;
  corvo::SE3 pose;  // The world is the camera of the first image.
  for (int i = 3; i < argc; ++i) {
    const Features features = extractor.Extract(cv::imread(argv[i], cv::IMREAD_GRAYSCALE));
    if (!map) map = Triangulate(first, features, camera);
    if (!map) continue;
    const corvo::PoseEstimate located = Locate(features, *map, pose, camera);
    if (located.num_inliers < 20) break;  // The map has left the view.
    pose = located.world_from_camera;
    std::cout << argv[i] << ' ' << located.num_inliers << ' ' << pose.translation().transpose()
              << '\n';
  }
}
