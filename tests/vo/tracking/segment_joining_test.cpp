// SPDX-License-Identifier: MIT
#include "vo/tracking/segment_joining.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// A map in which three keyframes of a first segment and three of a second one see the same scene.
/// The second segment has another world and another scale.
class SegmentJoiningTest : public ::testing::Test {
 protected:
  SegmentJoiningTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < 3; ++i) views.push_back(View(PoseAt(i)));
    map_ = test::MakeMap(scene_, views);
    num_landmarks_of_first_ = map_.num_landmark_ids();
    for (int i = 0; i < 3; ++i) AddToSecond(PoseAt(0.5 + 0.5 * i));
  }

  static SE3 PoseAt(double i) {
    return SE3(SO3::Exp({0, 0.02 * i, 0}), Eigen::Vector3d(0.3 * i, 0, 0));
  }

  test::SceneView View(const SE3& pose) {
    return test::ObserveScene(scene_, camera_, pose, 0.3, random_);
  }

  /// Adds a keyframe to the second segment, given its pose in the first one. From the second on, it
  /// shares new landmarks with the one before.
  void AddToSecond(const SE3& pose, int segment = 1) {
    const test::SceneView view = View(pose);
    Frame frame = view.frame;
    frame.world_from_camera = TransformPose(second_from_first_, pose);
    const KeyframeId id = map_.AddKeyframe(frame, segment);
    std::vector<TrackElement> seen(scene_.in_world.size());
    for (std::size_t k = 0; k < view.points.size(); ++k) {
      seen[view.points[k]] = {id, static_cast<int>(k)};
    }
    for (std::size_t point = 0; point < seen.size(); ++point) {
      if (seen[point].keyframe == kNoId || seen_[point].keyframe == kNoId) continue;
      const auto& [before, k] = seen_[point];
      const LandmarkId known = map_.keyframe(before).frame.landmarks[k];
      if (known != kNoId) {
        map_.AddTrackElement(known, seen[point]);
        continue;
      }
      map_.UpdateAppearance(map_.AddLandmark(second_from_first_ * scene_.in_world[point],
                                             {seen_[point], seen[point]}));
    }
    seen_ = seen;
  }

  /// Locates the newest keyframe in the first segment, too.
  TwiceLocated Locate() {
    Frame frame = map_.keyframe(map_.num_keyframes() - 1).frame;
    EXPECT_TRUE(Relocalizer(OdometryOptions()).Relocalize(0, map_, frame).is_tracked());
    return {map_.num_keyframes() - 1, 0, frame.world_from_camera, frame.landmarks};
  }

  test::Random random_{1};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(900, 3, 12, random_);
  const Sim3 second_from_first_{1.7, SO3::Exp({0.3, -1, 0.4}), {5, -2, 30}};
  std::vector<TrackElement> seen_ = std::vector<TrackElement>(scene_.in_world.size());
  Map map_{test::MakeModel()};
  int num_landmarks_of_first_ = 0;
  SegmentJoiningOptions options_;
};

TEST_F(SegmentJoiningTest, EstimatesTheSimilarityWithItsScale) {
  const auto estimate = EstimateJoin(map_, Locate(), options_);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->join.earlier, 0);
  EXPECT_EQ(estimate->join.later, 1);
  EXPECT_THAT(estimate->join.earlier_from_later,
              test::IsSimilarityNear(second_from_first_.Inverse(), 0.2, 0.3, 0.02));
}

TEST_F(SegmentJoiningTest, FewCommonLandmarksGiveNoEstimate) {
  TwiceLocated located = Locate();
  options_.min_common_landmarks = 10000;
  EXPECT_FALSE(EstimateJoin(map_, located, options_));
}

TEST_F(SegmentJoiningTest, DepthsThatDisagreeOnTheScaleGiveNoEstimate) {
  const TwiceLocated located = Locate();
  for (LandmarkId id = num_landmarks_of_first_; id < map_.num_landmark_ids(); ++id) {
    const Eigen::Vector3d camera = map_.WorldFromKeyframe(located.keyframe).translation();
    const double factor = id % 3 == 0 ? 0.5 : 1.0;
    map_.SetPosition(id, camera + factor * (map_.FindLandmark(id)->in_world - camera));
  }
  EXPECT_FALSE(EstimateJoin(map_, located, options_));
}

TEST_F(SegmentJoiningTest, EstimatesThatDifferInScaleRotationOrPositionAreInconsistent) {
  const JoinEstimate estimate = *EstimateJoin(map_, Locate(), options_);
  EXPECT_TRUE(AreConsistent(estimate, estimate, options_));
  const auto changed = [&](const Sim3& change) {
    JoinEstimate other = estimate;
    const Sim3 to_camera(1, SO3(), -estimate.camera_in_later);
    other.join.earlier_from_later =
        other.join.earlier_from_later * to_camera.Inverse() * change * to_camera;
    return other;
  };
  const auto are_consistent = [&](const Sim3& change) {
    return AreConsistent(changed(change), estimate, options_);
  };
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  EXPECT_TRUE(are_consistent(Sim3(1.1, SO3::Exp({0, 0.05, 0}), none)));
  EXPECT_FALSE(are_consistent(Sim3(1.2, SO3(), none)));
  EXPECT_FALSE(are_consistent(Sim3(1, SO3::Exp({0, 0.1, 0}), none)));
  EXPECT_FALSE(are_consistent(Sim3(1, SO3(), {5, 0, 0})));
  JoinEstimate of_another = estimate;
  of_another.join.earlier = 5;
  EXPECT_FALSE(AreConsistent(of_another, estimate, options_));
}

TEST_F(SegmentJoiningTest, ASecondKeyframeConfirmsTheSimilarity) {
  SegmentJoiner joiner{OdometryOptions()};
  EXPECT_FALSE(joiner.Search(map_));
  AddToSecond(PoseAt(1.8));
  EXPECT_TRUE(joiner.Search(map_));
  const std::optional<SegmentJoin> join = joiner.Estimate(map_);
  ASSERT_TRUE(join);
  EXPECT_THAT(join->earlier_from_later,
              test::IsSimilarityNear(second_from_first_.Inverse(), 0.2, 0.3, 0.02));
}

TEST_F(SegmentJoiningTest, ASegmentThatLostLandmarksIsNotJoined) {
  SegmentJoiner joiner{OdometryOptions()};
  joiner.Search(map_);
  AddToSecond(PoseAt(1.8));
  map_.MarginalizeKeyframe(3);  // The first one of the second segment.
  EXPECT_FALSE(joiner.Search(map_));
}

TEST_F(SegmentJoiningTest, AFrameThatShowsTwoSegmentsIsLocatedInTheGivenOne) {
  const Relocalizer relocalizer{OdometryOptions()};
  for (const int segment : {0, 1}) {
    test::SceneView view = View(PoseAt(1.2));
    EXPECT_TRUE(relocalizer.Relocalize(segment, map_, view.frame).is_tracked());
    EXPECT_EQ(SegmentOf(map_, view.frame), segment);
  }
}

TEST_F(SegmentJoiningTest, NothingIsFoundWithoutAnotherSegment) {
  const Map only_first = test::MakeMap(scene_, {View(PoseAt(0)), View(PoseAt(1))});
  map_ = only_first;
  SegmentJoiner joiner{OdometryOptions()};
  EXPECT_FALSE(joiner.Search(map_));
  EXPECT_FALSE(joiner.Search(map_));
}

TEST_F(SegmentJoiningTest, CommonLandmarksAreMergedIntoTheOlderOnes) {
  const TwiceLocated located = Locate();
  const SegmentJoin join = EstimateJoin(map_, located, options_)->join;
  map_.JoinSegments(join);
  const std::vector<LandmarkMerge> merges =
      MergeCommonLandmarks(located, options_.max_depth_factor, map_);
  EXPECT_GT(merges.size(), 100u);
  for (const LandmarkMerge& merge : merges) {
    EXPECT_LT(merge.into, num_landmarks_of_first_);
    EXPECT_GE(merge.from, num_landmarks_of_first_);
    EXPECT_EQ(map_.Resolve(merge.from), merge.into);
    const std::vector<TrackElement>& track = map_.FindLandmark(merge.into)->track;
    EXPECT_LT(track.front().keyframe, 3);
    EXPECT_EQ(track.back().keyframe, located.keyframe);
  }
  EXPECT_GT(map_.FindCovisible(located.keyframe).size(), 3u);
}

}  // namespace
}  // namespace corvo
