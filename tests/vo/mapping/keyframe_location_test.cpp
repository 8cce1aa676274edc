// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_location.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/vo/mapping/mapping_fixture.h"

namespace corvo {
namespace {

/// A map whose keyframes 0 to 2 and first landmarks are in an adjusted bundle; keyframes 3 and 4
/// and the other landmarks are newer.
class KeyframeLocationTest : public test::MappingTest {
 protected:
  static constexpr KeyframeId kNewest = 4;
  static constexpr LandmarkId kFirstNew = 60;

  KeyframeLocationTest() {
    MakeViews(kNewest + 1, 200);
    for (KeyframeId id = 0; id <= kNewest; ++id) true_poses_.push_back(map_.WorldFromKeyframe(id));
    for (LandmarkId id = 0; id < map_.num_landmark_ids(); ++id) {
      true_positions_.push_back(map_.FindLandmark(id)->in_world);
    }
  }

  Bundle AdjustedBundle() const {
    std::vector<LandmarkId> landmarks;
    for (LandmarkId id = 0; id < kFirstNew; ++id) landmarks.push_back(id);
    return CopyBundle(map_, {{0, 1, 2}, {}, landmarks});
  }

  /// Displaces what is newer than the bundle, as a whole.
  void DisplaceTheNewer() {
    const SE3 displacement(SO3::Exp({0, 0.005, 0}), {0.02, 0, 0.05});
    for (const KeyframeId id : {3, 4}) map_.SetPose(id, displacement * true_poses_[id]);
    for (const LandmarkId id : NewLandmarks()) {
      map_.SetPosition(id, displacement * true_positions_[id]);
    }
  }

  /// Returns the landmarks that are not in the bundle and that a newer keyframe observes.
  std::set<LandmarkId> NewLandmarks() const {
    std::set<LandmarkId> landmarks;
    for (const KeyframeId keyframe : {3, 4}) {
      for (const LandmarkId id : map_.LandmarksOf(keyframe)) {
        if (id >= kFirstNew) landmarks.insert(id);
      }
    }
    return landmarks;
  }

  double ErrorOf(KeyframeId id) const {
    return (true_poses_[id].Inverse() * map_.WorldFromKeyframe(id)).Log().norm();
  }
  double LandmarkErrorOf(LandmarkId id) const {
    return (map_.FindLandmark(id)->in_world - true_positions_[id]).norm();
  }
  /// Leaves a keyframe only `count` landmarks.
  void KeepLandmarks(KeyframeId id, std::size_t count) {
    const std::vector<LandmarkId> landmarks = map_.LandmarksOf(id);
    for (std::size_t i = count; i < landmarks.size(); ++i) {
      map_.RemoveTrackElement(landmarks[i], id);
    }
  }

  std::vector<SE3> true_poses_;
  std::vector<Eigen::Vector3d> true_positions_;
};

TEST_F(KeyframeLocationTest, NewerKeyframesAndLandmarksFollowTheAdjustedOnes) {
  DisplaceTheNewer();
  const double displaced = ErrorOf(3);
  ASSERT_GT(displaced, 0.04);
  LocateNewerKeyframes(AdjustedBundle(), OdometryOptions(), map_);
  EXPECT_LT(ErrorOf(3), 0.1 * displaced);
  EXPECT_LT(ErrorOf(4), 0.1 * displaced);
  for (const LandmarkId id : NewLandmarks()) EXPECT_LT(LandmarkErrorOf(id), 0.02) << id;
}

TEST_F(KeyframeLocationTest, WhatIsInTheBundleStays) {
  DisplaceTheNewer();
  LocateNewerKeyframes(AdjustedBundle(), OdometryOptions(), map_);
  for (KeyframeId id = 0; id < 3; ++id) EXPECT_EQ(ErrorOf(id), 0) << id;
  for (LandmarkId id = 0; id < kFirstNew; ++id) EXPECT_EQ(LandmarkErrorOf(id), 0) << id;
}

TEST_F(KeyframeLocationTest, AKeyframeWithFewLandmarksMovesWithTheOneBefore) {
  KeepLandmarks(4, 10);
  DisplaceTheNewer();
  LocateNewerKeyframes(AdjustedBundle(), OdometryOptions(), map_);
  EXPECT_LT(((true_poses_[3].Inverse() * true_poses_[4]).Inverse() *
             (map_.WorldFromKeyframe(3).Inverse() * map_.WorldFromKeyframe(4)))
                .Log()
                .norm(),
            1e-12);
}

TEST_F(KeyframeLocationTest, KeyframesOfAnotherSegmentStay) {
  DisplaceTheNewer();
  views_.push_back(test::ObserveScene(scene_, camera_, SE3(), 0.2, random_));
  const KeyframeId other = map_.AddKeyframe(views_.back().frame, 1);
  LocateNewerKeyframes(AdjustedBundle(), OdometryOptions(), map_);
  EXPECT_EQ(map_.WorldFromKeyframe(other), SE3());
}

}  // namespace
}  // namespace corvo
