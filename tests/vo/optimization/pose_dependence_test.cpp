// SPDX-License-Identifier: MIT
#include "vo/optimization/pose_dependence.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kPoseSigmaPx = 0.5;

/// A map of four keyframes and a frame that observes its landmarks.
class PoseDependenceTest : public ::testing::Test {
 protected:
  PoseDependenceTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < 4; ++i) views.push_back(View(i, kPoseSigmaPx));
    map_ = test::MakeMap(scene_, views, test::MakeModel(kPoseSigmaPx));
    const test::SceneView view = View(4, kPoseSigmaPx);
    frame_ = view.frame;
    for (int k = 0; k < frame_.num_keypoints(); ++k) {
      frame_.landmarks[k] = LandmarkAt(scene_.in_world[view.points[k]]);
    }
  }

  test::SceneView View(int i, double sigma_px) {
    const SE3 pose(SO3::Exp({0.02 * i, 0.05 * i, -0.01 * i}), {0.3 * i, 0.05 * i, 0.2 * i});
    return test::ObserveScene(scene_, test::PinholeCamera(), pose, sigma_px, random_);
  }

  LandmarkId LandmarkAt(const Eigen::Vector3d& in_world) const {
    for (LandmarkId id = 0; id < map_.num_landmark_ids(); ++id) {
      if (map_.FindLandmark(id)->in_world == in_world) return id;
    }
    return kNoId;
  }

  PoseDependence Linearize(const std::vector<KeyframeId>& keyframes) const {
    KeyframeCovariance joint;
    joint.keyframes = keyframes;
    return LinearizePose(map_, frame_, joint, {map_.camera().parameters(), {}});
  }

  test::Random random_{1};
  test::PointScene scene_ = test::MakeBoxScene(300, 4, 15, random_);
  Map map_{test::MakeModel()};
  Frame frame_;
};

TEST_F(PoseDependenceTest, TheFrameFollowsACommonMotionOfAllKeyframes) {
  // The world moves by Exp(η): keyframe k by Exp(Ad(k_from_world) η) on the right, and so does the
  // frame.
  const std::vector<KeyframeId> keyframes{0, 1, 2, 3};
  const PoseDependence dependence = Linearize(keyframes);
  SE3::Matrix6 sum = SE3::Matrix6::Zero();
  for (const KeyframeId id : keyframes) {
    sum += dependence.gains[id] * map_.WorldFromKeyframe(id).Inverse().Adjoint();
  }
  EXPECT_THAT(sum, test::IsMatrixNear(frame_.world_from_camera.Inverse().Adjoint(), 1e-6));
}

TEST_F(PoseDependenceTest, KeyframesThatAreNotAskedForAreExact) {
  const PoseDependence all = Linearize({0, 1, 2, 3});
  const PoseDependence some = Linearize({1, 3});
  EXPECT_EQ(some.gains[0], all.gains[1]);
  EXPECT_EQ(some.gains[1], all.gains[3]);
  EXPECT_EQ(some.noise, all.noise);
}

TEST_F(PoseDependenceTest, TheNoiseGrowsWithThatOfTheKeypoints) {
  MeasurementModel twice = map_.model();
  const PoseDependence once = Linearize({});
  // The landmarks are at their true places, so that the errors are those of the pixels alone.
  EXPECT_GT(once.detected.sum / once.detected.count, 0.3);
  EXPECT_LT(once.detected.sum / once.detected.count, 1);
  twice.options.keypoint_sigma_px *= 2;
  Map map(twice);
  for (KeyframeId id = 0; id < 4; ++id) {
    Frame frame = map_.keyframe(id).frame;
    frame.landmarks.assign(frame.landmarks.size(), kNoId);
    map.AddKeyframe(frame, 0);
  }
  for (LandmarkId id = 0; id < map_.num_landmark_ids(); ++id) {
    const Landmark& landmark = *map_.FindLandmark(id);
    map.AddLandmark(landmark.in_world, landmark.track);
  }
  const PoseDependence doubled = LinearizePose(map, frame_, {}, {map.camera().parameters(), {}});
  EXPECT_THAT(doubled.noise.diagonal().cwiseQuotient(once.noise.diagonal()).eval(),
              test::IsMatrixNear(Eigen::Matrix<double, 6, 1>::Constant(4), 0.2));
  EXPECT_NEAR(doubled.detected.sum / once.detected.sum, 0.25, 0.03);
}

TEST_F(PoseDependenceTest, AFrameWithoutLandmarksDependsOnNothing) {
  frame_.landmarks.assign(frame_.landmarks.size(), kNoId);
  const PoseDependence dependence = Linearize({0, 1});
  EXPECT_EQ(dependence.gains[0], SE3::Matrix6::Zero());
  EXPECT_EQ(dependence.aligned.count + dependence.detected.count, 0);
}

}  // namespace
}  // namespace corvo
