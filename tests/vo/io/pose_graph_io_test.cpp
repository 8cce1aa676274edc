// SPDX-License-Identifier: MIT
#include "vo/io/pose_graph_io.h"

#include <gmock/gmock.h>

namespace corvo {
namespace {

PoseGraph TwoKeyframes() {
  PoseGraph graph;
  graph.vertices = {{3, 10, 0, SE3()}, {5, 20, 0, SE3(SO3(), {1, 2, 3})}};
  Eigen::Matrix<double, 7, 1> variances;
  variances << 1, 0.5, 0.25, 0.01, 0.02, 0.04, 0.001;
  graph.edges = {{3, 5, SE3(SO3(), {1, 2, 3}), variances.asDiagonal().toDenseMatrix()}};
  return graph;
}

TEST(PoseGraphIoTest, WritesG2oWithPoses) {
  EXPECT_EQ(ToG2o(TwoKeyframes(), G2oForm::kSe3),
            "VERTEX_SE3:QUAT 3 0 0 0 0 0 0 1\n"
            "VERTEX_SE3:QUAT 5 1 2 3 0 0 0 1\n"
            "EDGE_SE3:QUAT 3 5 1 2 3 0 0 0 1"
            " 1 0 0 0 0 0 2 0 0 0 0 4 0 0 0 100 0 0 50 0 25\n");
}

TEST(PoseGraphIoTest, WritesG2oWithSimilarities) {
  EXPECT_EQ(ToG2o(TwoKeyframes(), G2oForm::kSim3),
            "VERTEX_SIM3:QUAT 3 0 0 0 0 0 0 1 1\n"
            "VERTEX_SIM3:QUAT 5 1 2 3 0 0 0 1 1\n"
            "EDGE_SIM3:QUAT 3 5 1 2 3 0 0 0 1 1"
            " 1 0 0 0 0 0 0 2 0 0 0 0 0 4 0 0 0 0 100 0 0 0 50 0 0 25 0 1000\n");
}

TEST(PoseGraphIoTest, AnExactUnitHasAFiniteInformation) {
  PoseGraph graph = TwoKeyframes();
  graph.edges[0].covariance(2, 2) = 0;
  EXPECT_THAT(ToG2o(graph, G2oForm::kSe3), Not(::testing::HasSubstr("inf")));
  EXPECT_THAT(ToG2o(graph, G2oForm::kSe3), Not(::testing::HasSubstr("nan")));
}

}  // namespace
}  // namespace corvo
