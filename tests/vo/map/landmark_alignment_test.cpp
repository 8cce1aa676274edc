// SPDX-License-Identifier: MIT
#include "vo/map/landmark_alignment.h"

#include <gmock/gmock.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "orb/extractor.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kDepth = 4;

/// Renders a wall at z = kDepth with a texture of blobs.
cv::Mat RenderWall(const Camera& camera, const SE3& world_from_camera) {
  cv::Mat image(camera.height(), camera.width(), CV_8UC1);
  const Eigen::Vector3d center = world_from_camera.translation();
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const Eigen::Vector3d ray =
          world_from_camera.rotation() * camera.Undistort(Eigen::Vector2d(u, v))->homogeneous();
      const Eigen::Vector3d wall = center + (kDepth - center.z()) / ray.z() * ray;
      const double gray = 128 + 50 * std::sin(23 * wall.x()) * std::cos(19 * wall.y() + wall.x()) +
                          40 * std::sin(11 * wall.x() - 13 * wall.y());
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(gray);
    }
  }
  return image;
}

Frame ExtractView(const orb::Extractor& extractor, const Camera& camera, const SE3& pose) {
  orb::Features features;
  std::vector<orb::Patch> patches;
  extractor.Extract(RenderWall(camera, pose), cv::Mat(), features, patches);
  Frame frame = MakeFrame(0, 0, std::move(features), camera, std::move(patches));
  frame.world_from_camera = pose;
  return frame;
}

/// Returns the point of the wall that keypoint `k` of a frame observes.
Eigen::Vector3d OnWall(const Frame& frame, int k) {
  const Eigen::Vector3d ray = frame.world_from_camera.rotation() * frame.rays[k].homogeneous();
  const Eigen::Vector3d& center = frame.world_from_camera.translation();
  return center + (kDepth - center.z()) / ray.z() * ray;
}

/// Returns the nearest keypoint in `octave`, or kNoId if none is within 2 px at the resolution of
/// the octave.
int FindKeypoint(const Frame& frame, const Eigen::Vector2d& pixel, int octave, double scale) {
  int nearest = kNoId;
  double least = 2 * scale;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const double distance = (frame.detected_pixel(k) - pixel).norm();
    if (frame.keypoint(k).octave != octave || distance > least) continue;
    nearest = k;
    least = distance;
  }
  return nearest;
}

TEST(LandmarkAlignmentTest, AlignmentReducesTheReprojectionError) {
  const Camera camera = test::PinholeCamera();
  const orb::Extractor extractor;
  const std::vector<double>& scales = extractor.octave_scales();
  const SE3 second_pose(SO3::Exp({0.01, -0.03, 0.06}), {0.15, -0.05, 0.1});
  Map map(test::MakeModel());
  map.AddKeyframe(ExtractView(extractor, camera, SE3()), 0);
  map.AddKeyframe(ExtractView(extractor, camera, second_pose), 0);
  const Frame& first = map.keyframe(0).frame;
  const Frame& second = map.keyframe(1).frame;
  double squared_before = 0, squared_after = 0;
  int num_seen = 0, num_aligned = 0;
  for (int k = 0; k < first.num_keypoints(); ++k) {
    const Eigen::Vector3d point = OnWall(first, k);
    const Eigen::Vector2d expected = *camera.Project(second_pose.Inverse() * point);
    const int octave = first.keypoint(k).octave;
    const int seen = FindKeypoint(second, expected, octave, scales[octave]);
    if (seen == kNoId || second.landmarks[seen] != kNoId) continue;
    ++num_seen;
    const LandmarkId id = map.AddLandmark(point, {{0, k}, {1, seen}});
    const double before = (second.pixel(seen) - expected).norm() / scales[octave];
    if (!AlignTrackElement(id, {1, seen}, map)) continue;
    ++num_aligned;
    squared_before += before * before;
    squared_after +=
        (second.pixel(seen) - expected).squaredNorm() / (scales[octave] * scales[octave]);
    EXPECT_THAT(second.rays[seen],
                test::IsMatrixNear(*camera.Undistort(second.pixel(seen)), 1e-12));
  }
  ASSERT_GT(num_seen, 100);
  EXPECT_GT(num_aligned, 0.7 * num_seen);
  EXPECT_LT(std::sqrt(squared_after), 0.25 * std::sqrt(squared_before));
}

TEST(LandmarkAlignmentTest, TheReferenceObservationIsNotMoved) {
  const Camera camera = test::PinholeCamera();
  const orb::Extractor extractor;
  Map map(test::MakeModel());
  map.AddKeyframe(ExtractView(extractor, camera, SE3()), 0);
  map.AddKeyframe(ExtractView(extractor, camera, SE3(SO3(), {0.1, 0, 0})), 0);
  const LandmarkId id = map.AddLandmark(OnWall(map.keyframe(0).frame, 5), {{0, 5}, {1, 5}});
  EXPECT_FALSE(AlignTrackElement(id, {0, 5}, map));
  EXPECT_EQ(map.keyframe(0).frame.pixel(5), map.keyframe(0).frame.detected_pixel(5));
}

TEST(LandmarkAlignmentTest, KeypointsWithoutPatchesAreNotMoved) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(50, 3, 8, random);
  const std::vector<test::SceneView> views = {
      test::ObserveScene(scene, test::PinholeCamera(), SE3(), 0, random),
      test::ObserveScene(scene, test::PinholeCamera(), SE3(SO3(), {0.2, 0, 0}), 0, random)};
  const Map map = test::MakeMap(scene, views);
  Frame frame = map.keyframe(1).frame;
  const std::vector<Eigen::Vector2d> pixels = frame.pixels;
  AlignKeypoints(map, frame);
  EXPECT_EQ(frame.pixels, pixels);
}

}  // namespace
}  // namespace corvo
