// SPDX-License-Identifier: MIT
#include "vo/tracking/tracker.h"

#include <gmock/gmock.h>

#include <set>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// A map of three views 0.3 apart along x; the last one is the previous frame.
class TrackerTest : public ::testing::Test {
 protected:
  TrackerTest() {
    for (int i = 0; i < 3; ++i) views_.push_back(View(Shifted(0.3 * i)));
    map_ = test::MakeMap(scene_, views_);
    previous_ = map_.keyframe(2).frame;
  }

  static SE3 Shifted(double x) { return SE3(SO3(), Eigen::Vector3d(x, 0, 0)); }

  test::SceneView View(const SE3& pose, double sigma_px = 0.3) {
    return test::ObserveScene(scene_, camera_, pose, sigma_px, random_);
  }

  TrackingResult TrackNext(const SE3& predicted, Frame& frame) const {
    return Tracker(OdometryOptions()).Track(map_, previous_, {predicted}, frame);
  }

  /// Adds keypoints whose descriptors resemble landmarks of the previous frame, but less than those
  /// of the true keypoints: `num_in_place` where `pose` predicts them, then `num_around`
  /// within 10 px of the prediction in x and y.
  Frame AddDecoys(const Frame& frame, const SE3& pose, int num_in_place, int num_around) {
    orb::Features features = frame.features;
    for (int k = 0; k < num_in_place + num_around; ++k) {
      const Landmark* landmark = map_.FindLandmark(previous_.landmarks[k]);
      if (landmark == nullptr) continue;
      const auto pixel = camera_.Project(pose.Inverse() * landmark->in_world);
      if (!pixel) continue;
      orb::Keypoint keypoint;
      const double spread_px = k < num_in_place ? 0 : 10;
      keypoint.x = static_cast<float>(pixel->x() + random_.Uniform(-spread_px, spread_px));
      keypoint.y = static_cast<float>(pixel->y() + random_.Uniform(-spread_px, spread_px));
      features.keypoints.push_back(keypoint);
      features.descriptors.push_back(test::FlipBits(previous_.descriptor(k), 40, random_));
    }
    return MakeFrame(0, 0, features, camera_);
  }

  test::Random random_{1};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(600, 3, 12, random_);
  std::vector<test::SceneView> views_;
  Map map_{test::MakeModel()};
  Frame previous_;
};

TEST_F(TrackerTest, LocatesAFrameAndAssignsItsLandmarks) {
  const SE3 truth = Shifted(0.9) * SE3::Exp(random_.Vector<6>(0.01));
  test::SceneView view = View(truth);
  view.frame.world_from_camera = SE3();
  const TrackingResult result = TrackNext(Shifted(0.9), view.frame);
  EXPECT_EQ(result.reason, Reason::kNone);
  EXPECT_THAT(view.frame.world_from_camera, test::IsPoseNear(truth, 0.1, 0.02));
  EXPECT_GT(result.num_inliers, 150);
  EXPECT_GE(result.num_matches, result.num_inliers);
  int num_named = 0;
  for (int k = 0; k < view.frame.num_keypoints(); ++k) {
    const Landmark* landmark = map_.FindLandmark(view.frame.landmarks[k]);
    if (landmark == nullptr) continue;
    ++num_named;
    EXPECT_EQ(landmark->in_world, scene_.in_world[view.points[k]]);
  }
  EXPECT_EQ(num_named, result.num_inliers);
}

TEST_F(TrackerTest, FindsLandmarksThatThePreviousFrameDoesNotObserve) {
  for (int k = 0; k < previous_.num_keypoints(); k += 2) previous_.landmarks[k] = kNoId;
  test::SceneView view = View(Shifted(0.9));
  const TrackingResult result = TrackNext(Shifted(0.9), view.frame);
  std::set<LandmarkId> of_previous(previous_.landmarks.begin(), previous_.landmarks.end());
  int num_others = 0;
  for (const LandmarkId id : view.frame.landmarks) num_others += of_previous.count(id) == 0;
  EXPECT_GT(num_others, 80);
  EXPECT_GT(result.visible.size(), 200u);
}

TEST_F(TrackerTest, ToleratesABadPrediction) {
  const SE3 truth(SO3::Exp({0, 0.15, 0}), Eigen::Vector3d(1.0, 0, 0));  // 75 px off.
  test::SceneView view = View(truth);
  EXPECT_EQ(TrackNext(Shifted(0.6), view.frame).reason, Reason::kNone);
  EXPECT_THAT(view.frame.world_from_camera, test::IsPoseNear(truth, 0.1, 0.02));
}

TEST_F(TrackerTest, FindsAFrameNearAnyOfThePredictions) {
  const SE3 truth = Shifted(0.6);
  const SE3 far = truth * SE3(SO3::Exp({0, 0.3, 0}), Eigen::Vector3d::Zero());  // 150 px off.
  OdometryOptions options;
  options.matching.max_distance = 0;  // Frames cannot be matched without a prediction.
  const Tracker tracker(options);
  test::SceneView view = View(truth);
  EXPECT_FALSE(tracker.Track(map_, previous_, {far}, view.frame).is_tracked());
  EXPECT_TRUE(tracker.Track(map_, previous_, {far, far, truth}, view.frame).is_tracked());
  EXPECT_THAT(view.frame.world_from_camera, test::IsPoseNear(truth, 0.1, 0.02));
}

TEST_F(TrackerTest, IsNotMisledBySimilarKeypointsNearABadPrediction) {
  const SE3 predicted = Shifted(0.9);
  const SE3 truth = predicted * SE3(SO3::Exp({0, 0.04, 0}), Eigen::Vector3d::Zero());  // 20 px off.
  const test::SceneView view = View(truth);
  Frame seen = AddDecoys(view.frame, predicted, 40, 160);
  EXPECT_EQ(TrackNext(predicted, seen).reason, Reason::kNone);
  EXPECT_THAT(seen.world_from_camera, test::IsPoseNear(truth, 0.1, 0.02));
}

TEST_F(TrackerTest, ReportsThatNothingMatches) {
  scene_ = test::MakeBoxScene(600, 3, 12, random_);  // A different scene.
  test::SceneView view = View(Shifted(0.6));
  EXPECT_EQ(TrackNext(Shifted(0.6), view.frame).reason, Reason::kTooFewMatches);
  Frame blank;
  EXPECT_EQ(TrackNext(Shifted(0.6), blank).reason, Reason::kTooFewMatches);
}

TEST_F(TrackerTest, FollowsMergedLandmarks) {
  // One landmark of the previous frame is merged into another one.
  Map map(test::MakeModel());
  for (const test::SceneView& view : views_) map.AddKeyframe(view.frame, 0);
  test::SceneView view = View(Shifted(0.9));
  Frame previous = map_.keyframe(2).frame;
  map = map_;
  const LandmarkId kept = previous.landmarks[0], gone = previous.landmarks[1];
  ASSERT_NE(kept, kNoId);
  ASSERT_NE(gone, kNoId);
  map.MergeLandmark(gone, kept);
  const Tracker tracker{OdometryOptions()};
  EXPECT_TRUE(tracker.Track(map, previous, {Shifted(0.9)}, view.frame).is_tracked());
  std::set<LandmarkId> seen;
  for (const LandmarkId id : view.frame.landmarks) {
    if (id == kNoId) continue;
    EXPECT_TRUE(seen.insert(id).second) << id;
  }
  EXPECT_EQ(seen.count(gone), 0u);
}

}  // namespace
}  // namespace corvo
