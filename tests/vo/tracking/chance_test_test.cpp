// SPDX-License-Identifier: MIT
#include "vo/tracking/chance_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// A map of two views, and frames that show some of its points among clutter. Half of all
/// descriptors are near enough to match, so that chance matches abound.
class ChanceTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  ChanceTest() {
    const std::vector<test::SceneView> views = {View(0), View(0.3)};
    map_ = test::MakeMap(scene_, views);
    for (LandmarkId id = 0; id < map_.num_landmark_ids(); ++id) {
      if (map_.FindLandmark(id) != nullptr) landmarks_.push_back(id);
    }
  }

  test::SceneView View(double x) {
    return test::ObserveScene(scene_, camera_, SE3(SO3(), {x, 0, 0}), 0.5, random_);
  }

  /// Returns a frame at x = 0.6 with the first `num_points` of its keypoints and `num_clutter`
  /// others.
  Frame MakeFrameWithClutter(int num_points, int num_clutter) {
    const Frame view = View(0.6).frame;
    orb::Features features = view.features;
    features.keypoints.resize(num_points);
    features.descriptors.resize(num_points);
    for (int i = 0; i < num_clutter; ++i) {
      orb::Keypoint keypoint;
      keypoint.x = static_cast<float>(random_.Uniform(0, camera_.width() - 1));
      keypoint.y = static_cast<float>(random_.Uniform(0, camera_.height() - 1));
      features.keypoints.push_back(keypoint);
      features.descriptors.push_back(test::RandomDescriptor(random_));
    }
    Frame frame = MakeFrame(2, 0, features, camera_);
    frame.world_from_camera = view.world_from_camera;
    return frame;
  }

  bool IsBeyond(const Frame& frame) const { return IsBeyondChance(map_, landmarks_, frame, {128}); }

  test::Random random_{GetParam()};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(600, 3, 12, random_);
  Map map_{test::MakeModel()};
  std::vector<LandmarkId> landmarks_;
};

TEST_P(ChanceTest, MatchesWithClutterAreChanceHoweverManyTheyAre) {
  EXPECT_FALSE(IsBeyond(MakeFrameWithClutter(0, 500)));
  EXPECT_FALSE(IsBeyond(MakeFrameWithClutter(0, 5000)));
  EXPECT_FALSE(IsBeyond(MakeFrameWithClutter(0, 20000)));
}

TEST_P(ChanceTest, AFewMatchesAreMeaningfulIfThereIsLittleClutter) {
  EXPECT_TRUE(IsBeyond(MakeFrameWithClutter(25, 0)));
  EXPECT_TRUE(IsBeyond(MakeFrameWithClutter(40, 500)));
}

TEST_P(ChanceTest, AllLandmarksAreMeaningful) {
  const test::SceneView view = View(0.6);
  std::vector<LandmarkId> shown;
  for (const LandmarkId id : landmarks_) {
    const Eigen::Vector3d& in_world = map_.FindLandmark(id)->in_world;
    const bool is_shown = std::ranges::any_of(
        view.points, [&](int point) { return scene_.in_world[point] == in_world; });
    if (is_shown && shown.size() < 30) shown.push_back(id);
  }
  EXPECT_TRUE(IsBeyondChance(map_, shown, view.frame, {128}));
}

/// Where nothing matches by chance in four times thirty places, one match in 121 is assumed. With
/// three matches for free, n others of thirty have a probability of exp(-30 KL(n/30 | 1/121)): 5e-4
/// for four and 2e-5 for five.
TEST_P(ChanceTest, EightMatchesOfThirtyLandmarksAreTheFewestThatAreMeaningfulWithoutClutter) {
  const test::SceneView view = View(0.6);
  std::vector<LandmarkId> shown;
  std::vector<int> keypoints;
  for (int k = 0; k < view.frame.num_keypoints() && shown.size() < 30; ++k) {
    const Eigen::Vector2d pixel = view.frame.pixel(k);
    if (std::abs(pixel.x() - 320) > 260 || std::abs(pixel.y() - 240) > 180) continue;
    const auto is_shown = [&](LandmarkId id) {
      return map_.FindLandmark(id)->in_world == scene_.in_world[view.points[k]];
    };
    const auto landmark = std::ranges::find_if(landmarks_, is_shown);
    if (landmark == landmarks_.end()) continue;
    shown.push_back(*landmark);
    keypoints.push_back(k);
  }
  ASSERT_EQ(shown.size(), 30u);
  const auto is_beyond = [&](int num_matches) {
    Frame frame = view.frame;
    SelectKeypoints({keypoints.begin(), keypoints.begin() + num_matches}, frame);
    return IsBeyondChance(map_, shown, frame, {64});
  };
  EXPECT_FALSE(is_beyond(7));
  EXPECT_TRUE(is_beyond(8));
}

TEST_P(ChanceTest, AFewMatchesAreNotMeaningfulAmongDenseClutter) {
  EXPECT_FALSE(IsBeyond(MakeFrameWithClutter(20, 20000)));
  EXPECT_TRUE(IsBeyond(MakeFrameWithClutter(200, 20000)));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ChanceTest, testing::Values(1, 2, 3, 4, 5, 6, 7, 8));

}  // namespace
}  // namespace corvo
