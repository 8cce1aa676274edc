// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle_adjuster.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Views 0.3 apart along x of a box of points.
struct ObservedPath {
  test::PointScene scene;
  std::vector<test::SceneView> views;
};

ObservedPath MakePath(int num_views, double sigma_px, test::Random& random) {
  ObservedPath path;
  path.scene = test::MakeBoxScene(300, 3, 12, random);
  for (int i = 0; i < num_views; ++i) {
    const SE3 pose(SO3::Exp({0, 0.02 * i, 0}), Eigen::Vector3d(0.3 * i, 0, 0));
    path.views.push_back(
        test::ObserveScene(path.scene, test::PinholeCamera(), pose, sigma_px, random));
  }
  return path;
}

/// Displaces all keyframes except the first `num_kept`, and all landmarks.
void Disturb(Map& map, int num_kept, test::Random& random) {
  for (KeyframeId id = num_kept; id < map.num_keyframes(); ++id) {
    map.SetPose(id, map.WorldFromKeyframe(id) * SE3::Exp(random.Vector<6>(0.01)));
  }
  for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
    map.SetPosition(id, map.FindLandmark(id)->in_world + random.Vector<3>(0.05));
  }
}

/// Adjusts the window around `newest` and removes outliers from the map.
AdjustmentSummary AdjustAround(Map& map, KeyframeId newest, int max_keyframes) {
  BundleAdjusterOptions options;
  options.max_keyframes = max_keyframes;
  options.max_iterations = 50;
  Bundle bundle = CopyBundle(map, SelectWindow(map, newest, options));
  const AdjustmentSummary summary =
      BundleAdjuster(WindowAdjustment(options)).Adjust(test::PinholeCamera(), bundle);
  WriteBack(bundle, map);
  return summary;
}

int CountTrackElements(const Map& map) {
  int count = 0;
  for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr) count += static_cast<int>(landmark->track.size());
  }
  return count;
}

TEST(WindowAdjustmentTest, WindowFreesTheMostCovisibleKeyframesAndFixesTheRest) {
  test::Random random(1);
  const ObservedPath path = MakePath(6, 0, random);
  const Map map = test::MakeMap(path.scene, path.views);
  BundleAdjusterOptions options;
  options.max_keyframes = 3;
  const AdjustmentWindow window = SelectWindow(map, 5, options);
  EXPECT_THAT(window.free, ElementsAre(3, 4, 5));
  EXPECT_THAT(window.fixed, ElementsAre(0, 1, 2));
  for (const LandmarkId id : window.landmarks) {
    EXPECT_GE(map.FindLandmark(id)->track.back().keyframe, 3);
  }
}

TEST(WindowAdjustmentTest, KeyframesThatObserveFewOfTheLandmarksAreLeftOut) {
  test::Random random(6);
  const ObservedPath path = MakePath(6, 0, random);
  const Map map = test::MakeMap(path.scene, path.views);
  BundleAdjusterOptions options;
  options.max_keyframes = 3;
  options.min_shared_landmarks = 10000;
  const AdjustmentWindow window = SelectWindow(map, 5, options);
  EXPECT_THAT(window.free, ElementsAre(5));
  EXPECT_THAT(window.fixed, IsEmpty());
}

TEST(WindowAdjustmentTest, FixedKeyframesRestoreTheExactMap) {
  test::Random random(2);
  const ObservedPath path = MakePath(6, 0, random);
  Map map = test::MakeMap(path.scene, path.views);
  Disturb(map, 3, random);
  const int num_before = CountTrackElements(map);
  const AdjustmentSummary summary = AdjustAround(map, 5, 3);
  EXPECT_TRUE(summary.is_usable()) << ToString(summary.status);
  EXPECT_LT(summary.final_cost, 1e-3 * summary.initial_cost);
  EXPECT_EQ(summary.num_inliers, summary.num_observations);
  EXPECT_EQ(CountTrackElements(map), num_before);
  for (KeyframeId id = 0; id < 6; ++id) {
    EXPECT_THAT(map.WorldFromKeyframe(id),
                test::IsPoseNear(path.views[id].frame.world_from_camera, 1e-3, 1e-4));
  }
}

TEST(WindowAdjustmentTest, WithoutFixedKeyframesTheFirstPoseAndTheFarthestDistanceAreKept) {
  test::Random random(3);
  const ObservedPath path = MakePath(4, 0.3, random);
  Map map = test::MakeMap(path.scene, path.views);
  Disturb(map, 1, random);
  const SE3 first = map.WorldFromKeyframe(0);
  const double distance = map.WorldFromKeyframe(3).translation().norm();
  ASSERT_TRUE(AdjustAround(map, 3, 10).is_usable());
  EXPECT_THAT(map.WorldFromKeyframe(0), test::IsPoseNear(first, 1e-9, 1e-9));
  EXPECT_NEAR(map.WorldFromKeyframe(3).translation().norm(), distance, 1e-9);
}

TEST(WindowAdjustmentTest, RemovesOutliersAndKeepsAllOtherTracks) {
  test::Random random(4);
  ObservedPath path = MakePath(5, 0.3, random);
  const int wrong = 7;
  path.views[4].frame.pixels[wrong].x() += 60;
  Map map = test::MakeMap(path.scene, path.views);
  const LandmarkId landmark = map.keyframe(4).frame.landmarks[wrong];
  ASSERT_NE(landmark, kNoId);
  const Map before = map;
  AdjustAround(map, 4, 3);
  for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
    if (id == landmark || before.FindLandmark(id) == nullptr) continue;
    EXPECT_EQ(map.FindLandmark(id)->track, before.FindLandmark(id)->track) << id;
  }
  EXPECT_EQ(map.keyframe(4).frame.landmarks[wrong], kNoId);
}

TEST(WindowAdjustmentTest, TheMapMayChangeDuringTheAdjustment) {
  test::Random random(7);
  const ObservedPath path = MakePath(5, 0.3, random);
  Map map = test::MakeMap(path.scene, path.views);
  Disturb(map, 1, random);
  Map adjusted_at_once = map;
  AdjustAround(adjusted_at_once, 4, 4);
  BundleAdjusterOptions options;
  options.max_keyframes = 4;
  options.max_iterations = 50;
  Bundle bundle = CopyBundle(map, SelectWindow(map, 4, options));
  map.CountSeen({}, map.keyframe(0).frame);
  BundleAdjuster(WindowAdjustment(options)).Adjust(test::PinholeCamera(), bundle);
  map.CountSeen({0}, Frame());
  WriteBack(bundle, map);
  EXPECT_EQ(map.WorldFromKeyframe(4), adjusted_at_once.WorldFromKeyframe(4));
  EXPECT_EQ(map.FindLandmark(0)->in_world, adjusted_at_once.FindLandmark(0)->in_world);
}

TEST(WindowAdjustmentTest, ResultIsIdenticalWhenRepeated) {
  test::Random random(5);
  const ObservedPath path = MakePath(5, 0.5, random);
  Map a = test::MakeMap(path.scene, path.views);
  Disturb(a, 1, random);
  Map b = a;
  AdjustAround(a, 4, 4);
  AdjustAround(b, 4, 4);
  for (KeyframeId id = 0; id < 5; ++id) {
    EXPECT_EQ(a.WorldFromKeyframe(id), b.WorldFromKeyframe(id));
  }
}

}  // namespace
}  // namespace corvo
