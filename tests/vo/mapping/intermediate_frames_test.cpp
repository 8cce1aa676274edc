// SPDX-License-Identifier: MIT
#include "vo/mapping/intermediate_frames.h"

#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {
namespace {

constexpr int kNumKeyframes = 4;

/// Keyframes 0.3 apart along x, and frames that follow the newest of them, 0.1 apart.
struct Drive {
  Drive(double sigma_px, std::uint64_t seed, int num_following = 3) {
    test::Random random(seed);
    const test::PointScene scene = test::MakeBoxScene(200, 3, 12, random);
    const auto view_at = [&](double x) {
      return test::ObserveScene(scene, test::PinholeCamera(), SE3(SO3(), {x, 0, 0}), sigma_px,
                                random);
    };
    std::vector<test::SceneView> keyframes;
    for (int i = 0; i < kNumKeyframes; ++i) keyframes.push_back(view_at(0.3 * i));
    map = test::MakeMap(scene, keyframes);
    std::map<int, LandmarkId> landmarks;
    for (KeyframeId id = 0; id < kNumKeyframes; ++id) {
      for (std::size_t k = 0; k < keyframes[id].points.size(); ++k) {
        const LandmarkId landmark = map.keyframe(id).frame.landmarks[k];
        if (landmark != kNoId) landmarks[keyframes[id].points[k]] = landmark;
      }
    }
    for (int i = 1; i <= num_following; ++i) {
      const test::SceneView view = view_at(0.3 * (kNumKeyframes - 1) + 0.1 * i);
      following.push_back(view.frame);
      following.back().index = 1000 + i;
      for (std::size_t k = 0; k < view.points.size(); ++k) {
        const auto found = landmarks.find(view.points[k]);
        if (found != landmarks.end()) following.back().landmarks[k] = found->second;
      }
    }
  }

  /// Returns a copy of the two newest keyframes, with the others fixed.
  Bundle CopyWindow() const { return CopyBundle(map, {{2, 3}, {0, 1}, map.FindObserved({2, 3})}); }

  Map map{test::MakeModel()};
  std::vector<Frame> following;
};

TEST(IntermediateFrames, AddsTheFrameInTheMiddleOfThoseThatFollowAKeyframe) {
  const Drive drive(0, 1);
  IntermediateFrames frames(10, 1);
  for (const Frame& frame : drive.following) frames.Add(frame, 0, drive.map);
  Bundle bundle = drive.CopyWindow();
  const std::size_t num_before = bundle.observations.size();
  frames.AddTo(drive.map, bundle);
  ASSERT_EQ(bundle.views.size(), kNumKeyframes + 1);
  const Bundle::View& added = bundle.views.back();
  EXPECT_EQ(added.keyframe, kNoId);
  EXPECT_FALSE(added.is_fixed);
  EXPECT_THAT(bundle.world_from_local * added.Pose(),
              test::IsPoseNear(drive.following[1].world_from_camera, 1e-9, 1e-9));
  EXPECT_EQ(bundle.observations.size(),
            num_before + static_cast<std::size_t>(CountObservedLandmarks(drive.following[1])));
}

TEST(IntermediateFrames, CountTheMemoryOfWhatTheyObserve) {
  const Drive drive(0, 1);
  IntermediateFrames frames(10, 1);
  EXPECT_EQ(frames.num_bytes(), 0u);
  for (const Frame& frame : drive.following) frames.Add(frame, 0, drive.map);
  std::size_t num_observations = 0;
  for (const Frame& frame : drive.following) {
    num_observations += static_cast<std::size_t>(CountObservedLandmarks(frame));
  }
  EXPECT_GT(frames.num_bytes(), num_observations * sizeof(Observation));
  frames.Clear();
  EXPECT_EQ(frames.num_bytes(), 0u);
}

TEST(IntermediateFrames, KeepsObservationsGroupedByPoint) {
  const Drive drive(0, 2);
  IntermediateFrames frames(10, 3);
  for (const Frame& frame : drive.following) frames.Add(frame, 0, drive.map);
  Bundle bundle = drive.CopyWindow();
  frames.AddTo(drive.map, bundle);
  const std::vector<int> offsets = ObservationOffsets(bundle);
  for (int point = 0; point < static_cast<int>(bundle.points.size()); ++point) {
    for (int i = offsets[point]; i < offsets[point + 1]; ++i) {
      EXPECT_EQ(bundle.observations[i].point, point);
      EXPECT_EQ(bundle.observations[i].landmark, bundle.points[point].landmark);
    }
  }
  VisitErrors(test::PinholeCamera(), bundle,
              [](const Bundle::Observation&, double error) { EXPECT_LT(error, 1e-6); });
}

TEST(IntermediateFrames, AreNeitherKeyframesNorFramesOfOtherSegmentsNorForgotten) {
  const Drive drive(0, 3);
  IntermediateFrames frames(10, 3);
  frames.Add(drive.map.keyframe(kNumKeyframes - 1).frame, 0, drive.map);
  frames.Add(drive.following[0], 1, drive.map);
  Bundle bundle = drive.CopyWindow();
  frames.AddTo(drive.map, bundle);
  EXPECT_EQ(bundle.views.size(), kNumKeyframes);
  frames.Add(drive.following[0], 0, drive.map);
  frames.Clear();
  frames.AddTo(drive.map, bundle);
  EXPECT_EQ(bundle.views.size(), kNumKeyframes);
}

TEST(IntermediateFrames, LeaveThePosesOfAnAdjustmentToItsKeyframes) {
  const Drive drive(0.5, 4);
  IntermediateFrames frames(10, 2);
  for (const Frame& frame : drive.following) frames.Add(frame, 0, drive.map);
  const Bundle plain = drive.CopyWindow();
  Bundle bundle = plain;
  frames.AddTo(drive.map, bundle);
  ASSERT_GT(bundle.views.size(), plain.views.size());
  IntermediateFrames::RemoveFrom(bundle);
  EXPECT_EQ(bundle.views.size(), plain.views.size());
  EXPECT_EQ(bundle.observations.size(), plain.observations.size());
  Map adjusted = drive.map;
  WriteBack(bundle, adjusted);
  for (KeyframeId id = 0; id < kNumKeyframes; ++id) {
    EXPECT_THAT(adjusted.WorldFromKeyframe(id),
                test::IsPoseNear(drive.map.WorldFromKeyframe(id), 1e-9, 1e-9));
  }
}

TEST(IntermediateFrames, MakeAWindowMoreAccurate) {
  const auto squared_error = [](Bundle& bundle) {
    const SE3 truth(SO3(), {0.3 * (kNumKeyframes - 1), 0, 0});
    BundleAdjuster({}).Adjust(test::PinholeCamera(), bundle);
    const SE3 pose = bundle.world_from_local * bundle.views[kNumKeyframes - 1].Pose();
    return (pose.translation() - truth.translation()).squaredNorm();
  };
  double without = 0, with = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Drive drive(0.5, seed);
    IntermediateFrames frames(10, 3);
    for (const Frame& frame : drive.following) frames.Add(frame, 0, drive.map);
    Bundle plain = drive.CopyWindow();
    Bundle bundle = plain;
    frames.AddTo(drive.map, bundle);
    without += squared_error(plain);
    with += squared_error(bundle);
  }
  EXPECT_LT(std::sqrt(with), 0.9 * std::sqrt(without));
}

}  // namespace
}  // namespace corvo
