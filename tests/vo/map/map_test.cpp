// SPDX-License-Identifier: MIT
#include "vo/map/map.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsNull;
using ::testing::NotNull;

/// Makes a frame with `num_keypoints` keypoints; descriptor i has its first i bits set.
Frame MakeBareFrame(int num_keypoints, const SE3& world_from_camera = SE3()) {
  orb::Features features;
  for (int i = 0; i < num_keypoints; ++i) {
    orb::Keypoint keypoint;
    keypoint.x = keypoint.y = static_cast<float>(100 + i);
    orb::Descriptor descriptor;
    for (int bit = 0; bit < i; ++bit) {
      descriptor.bytes[bit / 8] |= static_cast<std::uint8_t>(1 << (bit % 8));
    }
    features.keypoints.push_back(keypoint);
    features.descriptors.push_back(descriptor);
  }
  Frame frame = MakeFrame(0, 0, features, test::PinholeCamera());
  frame.world_from_camera = world_from_camera;
  return frame;
}

/// Expects that the landmarks and the keypoints of the keyframes refer to each other consistently.
void ExpectConsistent(const Map& map) {
  for (const KeyframeId id : map.ActiveKeyframes()) {
    const Frame& frame = map.keyframe(id).frame;
    for (int k = 0; k < static_cast<int>(frame.landmarks.size()); ++k) {
      if (frame.landmarks[k] == kNoId) continue;
      const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
      ASSERT_THAT(landmark, NotNull());
      EXPECT_THAT(landmark->track, ::testing::Contains(TrackElement{id, k}));
    }
  }
  for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    EXPECT_GE(landmark->track.size(), 2u);
    for (const TrackElement& o : landmark->track) {
      EXPECT_EQ(map.keyframe(o.keyframe).frame.landmarks[o.keypoint], id);
    }
  }
}

class MapTest : public ::testing::Test {
 protected:
  MapTest() {
    for (int i = 0; i < 4; ++i) {
      map_.AddKeyframe(MakeBareFrame(5, SE3(SO3(), Eigen::Vector3d(i, 0, 0))), 0);
    }
  }
  ~MapTest() override { ExpectConsistent(map_); }

  Map map_{test::MakeModel()};
};

TEST_F(MapTest, LandmarkAndKeypointsReferToEachOther) {
  const LandmarkId id = map_.AddLandmark({1, 2, 3}, {{2, 4}, {0, 1}});
  EXPECT_EQ(id, 0);
  EXPECT_THAT(map_.FindLandmark(id)->track, ElementsAre(TrackElement{0, 1}, TrackElement{2, 4}));
  EXPECT_EQ(map_.keyframe(0).frame.landmarks[1], id);
  EXPECT_EQ(map_.keyframe(2).frame.landmarks[4], id);
}

TEST_F(MapTest, AddKeyframeExtendsTheTracksOfItsLandmarks) {
  const LandmarkId id = map_.AddLandmark({1, 2, 3}, {{0, 1}, {2, 4}});
  Frame frame = MakeBareFrame(3);
  frame.landmarks[2] = id;
  const KeyframeId keyframe = map_.AddKeyframe(frame, 0);
  EXPECT_THAT(map_.FindLandmark(id)->track,
              ElementsAre(TrackElement{0, 1}, TrackElement{2, 4}, TrackElement{keyframe, 2}));
}

TEST_F(MapTest, LandmarkIsRemovedWhenASingleObservationRemains) {
  const LandmarkId id = map_.AddLandmark({1, 2, 3}, {{0, 0}, {1, 0}, {2, 0}});
  map_.RemoveTrackElement(id, 3);
  map_.RemoveTrackElement(id, 1);
  EXPECT_THAT(map_.FindLandmark(id), NotNull());
  map_.RemoveTrackElement(id, 0);
  EXPECT_THAT(map_.FindLandmark(id), IsNull());
  EXPECT_EQ(map_.Resolve(id), kNoId);
  EXPECT_EQ(map_.keyframe(2).frame.landmarks[0], kNoId);
}

TEST_F(MapTest, MergedLandmarkKeepsBothTracksAndItsIdResolves) {
  const LandmarkId a = map_.AddLandmark({1, 2, 3}, {{0, 0}, {1, 0}});
  const LandmarkId b = map_.AddLandmark({1, 2, 3}, {{1, 1}, {2, 1}});
  const LandmarkId c = map_.AddLandmark({1, 2, 3}, {{2, 2}, {3, 2}});
  map_.MergeLandmark(c, b);
  map_.MergeLandmark(b, a);
  EXPECT_EQ(map_.Resolve(c), a);
  EXPECT_EQ(map_.Resolve(b), a);
  EXPECT_EQ(map_.Resolve(a), a);
  EXPECT_EQ(map_.Resolve(kNoId), kNoId);
  EXPECT_THAT(map_.FindLandmark(a)->track, ElementsAre(TrackElement{0, 0}, TrackElement{1, 0},
                                                       TrackElement{2, 1}, TrackElement{3, 2}));
  EXPECT_EQ(map_.keyframe(1).frame.landmarks[1], kNoId);  // One keypoint per keyframe.
}

TEST_F(MapTest, CulledKeyframesMoveWithTheirAnchors) {
  map_.AddLandmark({1, 2, 3}, {{0, 0}, {1, 0}, {2, 0}});
  const SE3 relative = map_.WorldFromKeyframe(2).Inverse() * map_.WorldFromKeyframe(1);
  map_.CullKeyframe(1, 2);
  map_.CullKeyframe(2, 3);
  EXPECT_FALSE(map_.IsActive(1));
  EXPECT_TRUE(map_.IsCulled(1));
  EXPECT_FALSE(map_.IsCulled(3));
  const SE3 moved(SO3::Exp({0.1, 0.2, 0.3}), Eigen::Vector3d(5, 6, 7));
  const SE3 second_from_third = map_.WorldFromKeyframe(3).Inverse() * map_.WorldFromKeyframe(2);
  map_.SetPose(3, moved);
  EXPECT_THAT(map_.WorldFromKeyframe(2), test::IsPoseNear(moved * second_from_third, 1e-9, 1e-9));
  EXPECT_THAT(map_.WorldFromKeyframe(1),
              test::IsPoseNear(moved * second_from_third * relative, 1e-9, 1e-9));
}

TEST_F(MapTest, MarginalizedKeyframesKeepTheirPoses) {
  const SE3 pose = map_.WorldFromKeyframe(1);
  const SE3 retired = map_.WorldFromKeyframe(0);
  map_.AddLandmark({1, 2, 3}, {{0, 0}, {1, 0}, {2, 0}});
  map_.CullKeyframe(0, 1);
  map_.MarginalizeKeyframe(1);
  EXPECT_FALSE(map_.IsCulled(1));
  map_.SetPose(2, SE3(SO3::Exp({0.1, 0.2, 0.3}), Eigen::Vector3d(5, 6, 7)));
  EXPECT_EQ(map_.num_keyframes(), 4);
  EXPECT_THAT(map_.ActiveKeyframes(), ElementsAre(2, 3));
  EXPECT_EQ(map_.SegmentOf(1), 0);
  EXPECT_EQ(map_.WorldFromKeyframe(1), pose);
  EXPECT_THAT(map_.WorldFromKeyframe(0), test::IsPoseNear(retired, 1e-9, 1e-9));
  EXPECT_EQ(map_.AddKeyframe(MakeBareFrame(1), 0), 4);
}

TEST_F(MapTest, LandmarksAreMarginalizedWhenASingleObservationRemains) {
  const LandmarkId both = map_.AddLandmark({1, 2, 3}, {{0, 3}, {1, 3}});
  const LandmarkId longer = map_.AddLandmark({4, 5, 6}, {{0, 1}, {1, 1}, {2, 1}});
  const LandmarkId elsewhere = map_.AddLandmark({7, 8, 9}, {{2, 2}, {3, 2}});
  const std::vector<MarginalizedLandmark> finished = map_.MarginalizeKeyframe(0);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, both);
  EXPECT_EQ(finished[0].segment, 0);
  EXPECT_EQ(finished[0].in_world, Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(map_.FindLandmark(both), IsNull());
  EXPECT_EQ(map_.Resolve(both), kNoId);
  EXPECT_EQ(map_.keyframe(1).frame.landmarks[3], kNoId);
  EXPECT_THAT(map_.FindLandmark(longer)->track,
              ElementsAre(TrackElement{1, 1}, TrackElement{2, 1}));
  EXPECT_THAT(map_.FindLandmark(elsewhere), NotNull());
  EXPECT_EQ(map_.num_landmarks(), 2);
  EXPECT_EQ(map_.AddLandmark({1, 2, 3}, {{1, 0}, {2, 0}}), 3);  // Ids are not reused.
}

TEST_F(MapTest, OldMergesAreForgotten) {
  const LandmarkId a = map_.AddLandmark({1, 2, 3}, {{0, 0}, {1, 0}});
  const LandmarkId b = map_.AddLandmark({1, 2, 3}, {{2, 1}, {3, 1}});
  const LandmarkId c = map_.AddLandmark({1, 2, 3}, {{2, 2}, {3, 2}});
  map_.MergeLandmark(b, a);
  const KeyframeId newer = map_.AddKeyframe(MakeBareFrame(3), 0);
  map_.MergeLandmark(c, a);
  map_.ForgetMergesBefore(newer);
  EXPECT_EQ(map_.Resolve(b), kNoId);
  EXPECT_EQ(map_.Resolve(c), a);
}

TEST_F(MapTest, MarginalizationReleasesMemory) {
  const std::size_t before = map_.working_set_bytes();
  const KeyframeId first = map_.AddKeyframe(MakeBareFrame(200), 0);
  const KeyframeId second = map_.AddKeyframe(MakeBareFrame(200), 0);
  for (int k = 0; k < 200; ++k) map_.AddLandmark({1, 2, 3}, {{first, k}, {second, k}});
  EXPECT_GT(map_.working_set_bytes(), before + 2 * 200 * sizeof(orb::Descriptor));
  EXPECT_EQ(map_.MarginalizeKeyframe(first).size(), 200u);
  map_.MarginalizeKeyframe(second);
  constexpr std::size_t kBuckets = 4096;  // A hash map's table does not shrink.
  EXPECT_LT(map_.working_set_bytes(), before + kBuckets);
  EXPECT_LE(map_.keyframe_bytes(), 100u * static_cast<std::size_t>(map_.num_keyframes()));
}

TEST_F(MapTest, CovisibleKeyframesAreSortedByMostSharedThenNewest) {
  map_.AddLandmark({0, 0, 5}, {{0, 0}, {1, 0}});
  map_.AddLandmark({0, 0, 5}, {{0, 1}, {1, 1}, {2, 1}});
  map_.AddLandmark({0, 0, 5}, {{0, 2}, {3, 2}});
  const std::vector<Covisible> all = map_.FindCovisible(0);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].keyframe, 1);
  EXPECT_EQ(all[0].num_shared, 2);
  EXPECT_EQ(all[1].keyframe, 3);
  EXPECT_EQ(all[2].keyframe, 2);
  EXPECT_EQ(map_.FindCovisible(0, 2).size(), 1u);
}

TEST_F(MapTest, AppearanceIsTheMedoidAndTheMeanDirection) {
  // Sorted distances from descriptor 0: 0 2 3 4, from 2: 0 1 2 2, from 3: 0 1 1 3, from 4: 0 1 2 4.
  const LandmarkId id = map_.AddLandmark({1.5, 0, 10}, {{0, 0}, {1, 2}, {2, 3}, {3, 4}});
  map_.UpdateAppearance(id);
  const Landmark& landmark = *map_.FindLandmark(id);
  EXPECT_EQ(landmark.descriptor, map_.keyframe(1).frame.descriptor(2));
  EXPECT_THAT(landmark.view_direction, test::IsMatrixNear(Eigen::Vector3d(0, 0, 1), 1e-12));
  EXPECT_NEAR(landmark.max_distance, std::sqrt(102.25), 1e-12);
}

TEST(MapSegmentsTest, JoiningMovesKeyframesAndLandmarksOfTheLaterSegment) {
  Map map(test::MakeModel());
  const SE3 ahead(SO3::Exp({0, 0.2, 0}), {0, 0, 1});
  map.AddKeyframe(MakeBareFrame(3), 0);
  for (int i = 0; i < 3; ++i) map.AddKeyframe(MakeBareFrame(3, i == 1 ? ahead : SE3()), 1);
  map.AddKeyframe(MakeBareFrame(3, SE3(SO3(), {0, 0, 1})), 0);
  const LandmarkId first = map.AddLandmark({1, 0, 5}, {{0, 0}, {4, 0}});
  const LandmarkId second = map.AddLandmark({1, 2, 4}, {{1, 0}, {3, 0}});
  for (const LandmarkId id : {first, second}) map.UpdateAppearance(id);
  const double max_distance = map.FindLandmark(second)->max_distance;
  map.CullKeyframe(2, 1);
  EXPECT_EQ(map.NewestSegment(), 1);
  EXPECT_TRUE(map.IsMovable(1));
  const Sim3 move(2, SO3::Exp({0.1, 0.2, 0.3}), {7, 8, 9});
  map.JoinSegments({0, 1, move});
  EXPECT_EQ(map.NewestSegment(), 0);
  EXPECT_EQ(map.WorldFromKeyframe(0), SE3());
  EXPECT_EQ(map.FindLandmark(first)->in_world, Eigen::Vector3d(1, 0, 5));
  EXPECT_THAT(map.WorldFromKeyframe(1), test::IsPoseNear(TransformPose(move, SE3()), 1e-9, 1e-9));
  EXPECT_THAT(map.WorldFromKeyframe(2), test::IsPoseNear(TransformPose(move, ahead), 1e-9, 1e-9));
  EXPECT_EQ(map.keyframe(3).segment, 0);
  const Landmark& moved = *map.FindLandmark(second);
  EXPECT_EQ(moved.segment, 0);
  EXPECT_THAT(moved.in_world, test::IsMatrixNear(move * Eigen::Vector3d(1, 2, 4), 1e-9));
  EXPECT_NEAR(moved.max_distance, 2 * max_distance, 1e-9);
  const Eigen::Vector3d direction = moved.view_direction;
  map.UpdateAppearance(second);
  EXPECT_THAT(map.FindLandmark(second)->view_direction, test::IsMatrixNear(direction, 1e-9));
}

TEST(MapSegmentsTest, ASegmentWithAMarginalizedKeyframeIsNotMovable) {
  Map map(test::MakeModel());
  for (const int segment : {0, 0, 1}) map.AddKeyframe(MakeBareFrame(1), segment);
  map.MarginalizeKeyframe(0);
  EXPECT_FALSE(map.IsMovable(0));
  EXPECT_TRUE(map.IsMovable(1));
}

}  // namespace
}  // namespace corvo
