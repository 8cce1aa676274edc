// SPDX-License-Identifier: MIT
#include "vo/mapping/pose_uncertainty.h"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kLocatedSigmaPx = 0.5;

/// Keyframes along a path with the landmarks that they observe, and a frame after them.
class PoseUncertaintyTest : public ::testing::Test {
 protected:
  static constexpr int kNumViews = 8;

  PoseUncertaintyTest() {
    for (int i = 0; i < kNumViews; ++i) views_.push_back(View(i));
    map_ = MapOf(kNumViews - 1);
    frame_ = FrameIn(map_, views_.back());
  }

  test::SceneView View(int i) {
    const SE3 pose(SO3::Exp({0.01 * i, 0.03 * i, -0.01 * i}), {0.3 * i, 0.05 * i, 0.2 * i});
    test::SceneView view =
        test::ObserveScene(scene_, test::PinholeCamera(), pose, kLocatedSigmaPx, random_);
    view.frame.index = i;
    return view;
  }

  Map MapOf(int num_views) const {
    return test::MakeMap(scene_, {views_.begin(), views_.begin() + num_views},
                         test::MakeModel(kLocatedSigmaPx));
  }

  /// Returns the frame of a view with the landmarks of a map.
  Frame FrameIn(const Map& map, const test::SceneView& view) const {
    Frame frame = view.frame;
    for (int k = 0; k < frame.num_keypoints(); ++k) {
      for (LandmarkId id = 0; id < map.num_landmark_ids(); ++id) {
        const Landmark* landmark = map.FindLandmark(id);
        if (landmark->in_world == scene_.in_world[view.points[k]]) frame.landmarks[k] = id;
      }
    }
    return frame;
  }

  PoseUncertainty Uncertainty(const CameraPrior& prior) const { return {prior, {}}; }
  CameraPrior KnownCamera() const { return {map_.camera().parameters(), {}}; }

  test::Random random_{1};
  test::PointScene scene_ = test::MakeBoxScene(300, 4, 15, random_);
  std::vector<test::SceneView> views_;
  Map map_{test::MakeModel()};
  Frame frame_;
};

Eigen::Matrix<double, 6, 1> Sigmas(const SE3::Matrix6& covariance) {
  return covariance.diagonal().cwiseSqrt();
}

TEST_F(PoseUncertaintyTest, OfAFrameIsRelativeToTheNewestKeyframe) {
  PoseUncertainty uncertainty = Uncertainty(KnownCamera());
  uncertainty.ComputeWindow(map_, kNumViews - 2);
  const UncertaintyToKeyframe result = uncertainty.OfFrame(map_, frame_, {}).value();
  EXPECT_EQ(result.keyframe, kNumViews - 2);
  EXPECT_THAT(result.covariance, test::IsMatrixNear(result.covariance.transpose().eval(), 1e-12));
  EXPECT_GT(result.covariance.eigenvalues().real().minCoeff(), 0);
  // 300 points at 4 to 15 units, f = 500 px: the order of 0.5 px / 500 px / sqrt(300).
  EXPECT_GT(Sigmas(result.covariance).tail<3>().minCoeff(), 3e-5);
  EXPECT_LT(Sigmas(result.covariance).tail<3>().maxCoeff(), 5e-4);
}

TEST_F(PoseUncertaintyTest, IsComputedAnewWhereTheCameraHasReturnedTo) {
  PoseUncertainty uncertainty = Uncertainty(KnownCamera());
  EXPECT_EQ(uncertainty.OfFrame(map_, frame_, {})->keyframe, kNumViews - 2);
}

TEST_F(PoseUncertaintyTest, IsUnknownWithoutOtherKeyframes) {
  PoseUncertainty uncertainty = Uncertainty(KnownCamera());
  EXPECT_FALSE(uncertainty.OfNewestKeyframe(map_, frame_, {}));
  frame_.landmarks.assign(frame_.landmarks.size(), kNoId);
  EXPECT_FALSE(uncertainty.OfFrame(map_, frame_, {}));
  uncertainty.AddKeyframe(map_, frame_);
  EXPECT_THAT(uncertainty.joint().keyframes, ::testing::ElementsAre(kNumViews - 1));
}

TEST_F(PoseUncertaintyTest, AddedKeyframesAreAboutAsCertainAsAdjustedOnes) {
  // A frame becomes a keyframe before or after its window is adjusted.
  const Map larger = MapOf(kNumViews);
  PoseUncertainty adjusted = Uncertainty(KnownCamera());
  adjusted.ComputeWindow(larger, kNumViews - 1);
  PoseUncertainty added = Uncertainty(KnownCamera());
  added.ComputeWindow(map_, kNumViews - 2);
  added.OfFrame(map_, frame_, {});
  added.AddKeyframe(map_, frame_);
  adjusted.OfFrame(larger, FrameIn(larger, views_.back()), {});
  const UncertaintyToKeyframe before = added.OfNewestKeyframe(larger, frame_, {}).value();
  const UncertaintyToKeyframe after = adjusted.OfNewestKeyframe(larger, frame_, {}).value();
  EXPECT_EQ(before.keyframe, kNumViews - 2);
  EXPECT_EQ(after.keyframe, kNumViews - 2);
  const Eigen::Matrix<double, 6, 1> ratio =
      Sigmas(before.covariance).cwiseQuotient(Sigmas(after.covariance));
  EXPECT_GT(ratio.minCoeff(), 0.8);
  EXPECT_LT(ratio.maxCoeff(), 1.6);
}

TEST_F(PoseUncertaintyTest, IsAtLeastThatOfTheKeypointsAlone) {
  PoseUncertainty uncertainty = Uncertainty(KnownCamera());
  uncertainty.ComputeWindow(map_, kNumViews - 2);
  const UncertaintyToKeyframe all = uncertainty.OfFrame(map_, frame_, {}).value();
  const PoseDependence alone = LinearizePose(map_, frame_, {}, KnownCamera());
  const Eigen::Matrix<double, 6, 1> ratio =
      Sigmas(all.covariance).cwiseQuotient(Sigmas(alone.noise));
  EXPECT_GT(ratio.minCoeff(), 1);
}

TEST_F(PoseUncertaintyTest, GrowsWithTheUncertaintyOfTheCamera) {
  const CameraPrior prior{map_.camera().parameters(), {{"focal", 0.01}, {"k1", 0.02}}};
  PoseUncertainty uncertainty = Uncertainty(prior);
  uncertainty.ComputeWindow(map_, kNumViews - 2);
  CameraEstimate camera = PriorEstimate(prior);
  const SE3::Matrix6 uncertain = uncertainty.OfFrame(map_, frame_, camera)->covariance;
  camera.covariance *= 0;
  const SE3::Matrix6 certain = uncertainty.OfFrame(map_, frame_, camera)->covariance;
  const SE3::Matrix6 difference = uncertain - certain;
  EXPECT_GT(difference.trace(), 0.1 * certain.trace());
  EXPECT_GT(difference.eigenvalues().real().minCoeff(), -1e-6 * difference.trace());
}

}  // namespace
}  // namespace corvo
