// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_edges.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kEdgeSigmaPx = 0.5;

/// A map of keyframes along a path, whose edges are collected as they are added.
class KeyframeEdgesTest : public ::testing::Test {
 protected:
  static constexpr int kNumViews = 5;

  KeyframeEdgesTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < kNumViews; ++i) {
      const SE3 pose(SO3::Exp({0, 0.02 * i, 0}), {0.3 * i, 0, 0.2 * i});
      views.push_back(
          test::ObserveScene(scene_, test::PinholeCamera(), pose, kEdgeSigmaPx, random_));
      views.back().frame.index = 10 * i;
    }
    map_ = test::MakeMap(scene_, views, test::MakeModel(kEdgeSigmaPx));
    uncertainty_.ComputeWindow(map_, kNumViews - 1);
    edges_.AddKeyframe(map_, uncertainty_, {});
  }

  test::Random random_{1};
  test::PointScene scene_ = test::MakeBoxScene(300, 4, 15, random_);
  Map map_{test::MakeModel()};
  PoseUncertainty uncertainty_{{test::PinholeCamera().parameters(), {}}, {}};
  KeyframeEdges edges_;
};

TEST_F(KeyframeEdgesTest, ANewKeyframeHasEdgesToEarlierOnesOfItsSurroundings) {
  const PoseGraph graph = edges_.ToGraph(map_);
  ASSERT_EQ(graph.edges.size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(graph.edges[i].first, i);
    EXPECT_EQ(graph.edges[i].second, kNumViews - 1);
  }
  ASSERT_EQ(graph.vertices.size(), kNumViews);
  EXPECT_EQ(graph.vertices.back().frame, 40);
  const SE3 first_from_second =
      map_.WorldFromKeyframe(2).Inverse() * map_.WorldFromKeyframe(kNumViews - 1);
  EXPECT_THAT(graph.edges[2].first_from_second, test::IsPoseNear(first_from_second, 1e-9, 1e-9));
}

TEST_F(KeyframeEdgesTest, TheCovarianceOfEachOfSeveralEdgesCountsAsOften) {
  const PoseGraph graph = edges_.ToGraph(map_);
  const SE3::Matrix6 one = uncertainty_.Between(map_, 3, kNumViews - 1, {});
  EXPECT_THAT(Eigen::MatrixXd(graph.edges[3].covariance.topLeftCorner<6, 6>()),
              test::IsMatrixNear(4 * one, 1e-12));
  EXPECT_DOUBLE_EQ(graph.edges[3].covariance(6, 6),
                   4 * 2 * uncertainty_.factor() * LogScaleVariance(map_, 3, kNumViews - 1))
      << "twice, for the correlation of its errors between edges";
}

TEST_F(KeyframeEdgesTest, AreRenewedFromALaterWindow) {
  const SE3::Matrix6 before = edges_.ToGraph(map_).edges[3].covariance.topLeftCorner<6, 6>();
  Frame frame = map_.keyframe(kNumViews - 1).frame;
  // The factor of the newest frame enters the covariance.
  uncertainty_.OfFrame(map_, frame, {});
  edges_.Renew(map_, uncertainty_, {});
  const SE3::Matrix6 after = edges_.ToGraph(map_).edges[3].covariance.topLeftCorner<6, 6>();
  EXPECT_THAT(after, test::IsMatrixNear(uncertainty_.factor() * before, 1e-9 * after.norm()));
}

TEST_F(KeyframeEdgesTest, TheScaleHasTheErrorsOfTheKeyframesThatHandItOn) {
  PoseUncertainty uncertainty{{test::PinholeCamera().parameters(), {}}, {}};
  KeyframeEdges edges;
  std::vector<test::SceneView> views;
  for (int i = 0; i < 2 * kNumViews; ++i) {
    const SE3 pose(SO3::Exp({0, 0.02 * i, 0}), {0.3 * i, 0, 0.2 * i});
    views.push_back(test::ObserveScene(scene_, test::PinholeCamera(), pose, kEdgeSigmaPx, random_));
    views.back().frame.index = 10 * i;
    if (i < kNumViews) continue;
    Map map = test::MakeMap(scene_, views, test::MakeModel(kEdgeSigmaPx));
    uncertainty.ComputeWindow(map, i);
    edges.AddKeyframe(map, uncertainty, {});
    edges.Renew(map, uncertainty, {});
  }
  const Map map = test::MakeMap(scene_, views, test::MakeModel(kEdgeSigmaPx));
  const PoseGraph graph = edges.ToGraph(map);
  const auto edge = std::ranges::find_if(
      graph.edges, [](const PoseGraphEdge& e) { return e.first == 5 && e.second == 6; });
  ASSERT_NE(edge, graph.edges.end());
  const PoseGraphEdge::Matrix7 covariance = edge->covariance / 4;
  EXPECT_GT(covariance(6, 6), 2 * uncertainty.factor() * LogScaleVariance(map, 5, 6));
  EXPECT_GT(covariance.col(6).head<6>().norm(), 0) << "with the error of the pose";
  EXPECT_EQ(covariance.llt().info(), Eigen::Success);
}

TEST_F(KeyframeEdgesTest, AJoinExpressesTheLaterSegmentInTheUnitOfTheEarlier) {
  const double before = edges_.ToGraph(map_).edges[3].covariance(0, 0);
  edges_.JoinSegments({-1, 0, Sim3(3, SO3(), {0, 0, 0})});
  EXPECT_DOUBLE_EQ(edges_.ToGraph(map_).edges[3].covariance(0, 0), 9 * before);
}

TEST_F(KeyframeEdgesTest, TheScaleIsTransferredByCommonLandmarks) {
  // 300 landmarks whose distance is known to 0.3 to 3%: the order of 1% / sqrt(300).
  const double variance = LogScaleVariance(map_, 3, 4);
  EXPECT_GT(variance, 1e-8);
  EXPECT_LT(variance, 1e-5);
  for (const LandmarkId id : map_.LandmarksOf(4)) map_.RemoveTrackElement(id, 3);
  EXPECT_EQ(LogScaleVariance(map_, 3, 4), 1);
}

}  // namespace
}  // namespace corvo
