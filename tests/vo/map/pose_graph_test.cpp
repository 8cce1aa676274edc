// SPDX-License-Identifier: MIT
#include "vo/map/pose_graph.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

/// Returns three keyframes one unit apart, of the frames 0, 2 and 4, with an edge between each two.
PoseGraph ThreeKeyframes() {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) {
    graph.vertices.push_back({i, 2 * i, 0, SE3(SO3(), {0, 0, 1.0 * i})});
    for (int earlier = 0; earlier < i; ++earlier) {
      graph.edges.push_back({earlier, i, SE3(SO3(), {0, 0, 1.0 * (i - earlier)}),
                             PoseGraphEdge::Matrix7::Identity()});
    }
  }
  return graph;
}

/// Returns five frames that are two units apart.
Trajectory FiveFrames() {
  Trajectory trajectory;
  trajectory.frames.resize(5);
  for (int i = 0; i < 5; ++i) {
    trajectory.frames[i].segment = 0;
    trajectory.frames[i].world_from_camera = SE3(SO3(), {0, 0, 2.0 * i});
  }
  return trajectory;
}

const std::vector<double> kUnscaled(5, 1);

TEST(PoseGraphTest, TakesThePosesOfATrajectory) {
  const PoseGraph graph = WithPosesOf(FiveFrames(), {9, 9, 9, 9, 4}, ThreeKeyframes());
  ASSERT_EQ(graph.vertices.size(), 3);
  EXPECT_EQ(graph.vertices[2].world_from_camera, SE3(SO3(), {0, 0, 8}));
  ASSERT_EQ(graph.edges.size(), 3);
  EXPECT_THAT(graph.edges[1].first_from_second, test::IsPoseNear(SE3(SO3(), {0, 0, 8}), 0, 1e-12));
  Eigen::Matrix<double, 7, 1> variances;
  variances << 16, 16, 16, 1, 1, 1, 1;
  EXPECT_EQ(graph.edges[1].covariance, PoseGraphEdge::Matrix7(variances.asDiagonal()));
}

TEST(PoseGraphTest, WhatTheCameraCausesHasTheUnitOfTheTrajectory) {
  PoseGraph graph = ThreeKeyframes();
  graph.edges[1].by_camera = Eigen::VectorXd::Ones(7);
  const PoseGraph scaled = WithPosesOf(FiveFrames(), {9, 9, 9, 9, 4}, graph);
  Eigen::Matrix<double, 7, 1> by_camera;
  by_camera << 4, 4, 4, 1, 1, 1, 1;
  EXPECT_EQ(scaled.edges[1].by_camera, PoseGraphEdge::Matrix7X(by_camera));
}

TEST(PoseGraphTest, LeavesOutKeyframesWithoutAPoseOfTheirSegment) {
  Trajectory trajectory = FiveFrames();
  trajectory.frames[0].segment = 1;
  PoseGraph graph = WithPosesOf(trajectory, kUnscaled, ThreeKeyframes());
  ASSERT_EQ(graph.edges.size(), 1);
  EXPECT_EQ(graph.edges[0].first, 1);
  trajectory.frames[4].world_from_camera.reset();
  graph = WithPosesOf(trajectory, kUnscaled, ThreeKeyframes());
  EXPECT_EQ(graph.vertices.size(), 1);
  EXPECT_TRUE(graph.edges.empty());
}

}  // namespace
}  // namespace corvo
