// SPDX-License-Identifier: MIT
#include "vo/offline/expected_drift.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "vo/evaluation/evaluation.h"

namespace corvo {
namespace {

using Matrix7 = PoseGraphEdge::Matrix7;

/// Returns a drive in a bend, whose edges have the standard deviations `sigma` of [υ ω λ].
PoseGraph Bend(int num_keyframes, const Eigen::Matrix<double, 7, 1>& sigma, int segment = 0) {
  PoseGraph graph;
  for (int i = 0; i < num_keyframes; ++i) {
    const double angle = 0.05 * i;
    const SE3 pose(SO3::Exp({0, angle, 0}),
                   {20 * (1 - std::cos(angle)), 0.1 * i, 20 * std::sin(angle)});
    const int id = 1000 * segment + i;
    graph.vertices.push_back({id, 3 * id, segment, pose});
    if (i == 0) continue;
    const Matrix7 covariance = sigma.cwiseAbs2().asDiagonal();
    graph.edges.push_back({id - 1, id, SE3(), covariance});
  }
  return graph;
}

Eigen::Matrix<double, 7, 1> Sigma(double translation, double rotation, double log_scale) {
  Eigen::Matrix<double, 7, 1> sigma;
  sigma << translation, translation, translation, rotation, rotation, rotation, log_scale;
  return sigma;
}

/// Returns the poses of a graph whose edges have random errors.
PoseSequence Disturb(const PoseGraph& graph, std::mt19937& random) {
  std::normal_distribution<double> normal;
  PoseSequence poses = {{0, graph.vertices[0].world_from_camera}};
  double scale = 1;
  for (std::size_t i = 1; i < graph.vertices.size(); ++i) {
    Eigen::Matrix<double, 7, 1> error;
    for (int k = 0; k < 7; ++k) {
      error[k] = std::sqrt(graph.edges[i - 1].covariance(k, k)) * normal(random);
    }
    const SE3 step = graph.vertices[i - 1].world_from_camera.Inverse() *
                     graph.vertices[i].world_from_camera * SE3::Exp(error.head<6>());
    const SE3 scaled(step.rotation(), scale * step.translation());
    poses.push_back({static_cast<TimeNs>(i), poses.back().world_from_camera * scaled});
    scale *= std::exp(error[6]);
  }
  return poses;
}

TEST(ExpectedDriftTest, IsTheErrorOfTrajectoriesWithSuchErrors) {
  constexpr int kKeyframes = 40, kRuns = 400;
  const PoseGraph graph = Bend(kKeyframes, Sigma(0.002, 0.0005, 0.001));
  PoseSequence truth;
  for (const PoseGraphVertex& vertex : graph.vertices) {
    truth.push_back({static_cast<TimeNs>(truth.size()), vertex.world_from_camera});
  }
  std::mt19937 random;
  std::vector<double> squares(kKeyframes, 0);
  for (int run = 0; run < kRuns; ++run) {
    const Evaluation evaluation = Evaluate(Disturb(graph, random), truth);
    for (int i = 0; i < kKeyframes; ++i) {
      const PosePair& pair = evaluation.aligned_pairs[i];
      squares[i] += (pair.estimate_from_camera.translation() - pair.truth_from_camera.translation())
                        .squaredNorm();
    }
  }
  const std::vector<double> expected = ExpectedDrift(graph);
  for (int i = 0; i < kKeyframes; ++i) {
    EXPECT_NEAR(std::sqrt(squares[i] / kRuns), expected[i], 0.15 * expected[i]) << i;
  }
  EXPECT_GT(expected.front(), 1.5 * expected[kKeyframes / 4]) << "the ends are the least certain";
}

TEST(ExpectedDriftTest, TheErrorOfTheCameraIsTheSameForAllEdges) {
  PoseGraph graph = Bend(30, Sigma(0, 0, 0));
  const double sigma = 0.01;
  graph.camera_covariance = Eigen::MatrixXd::Constant(1, 1, sigma * sigma);
  Eigen::Matrix<double, 7, 1> by_camera;
  by_camera << 0.01, 0.02, 0.05, 0.001, 0.01, -0.002, 0.1;
  for (PoseGraphEdge& edge : graph.edges) {
    edge.by_camera = by_camera;
    edge.covariance = sigma * sigma * by_camera * by_camera.transpose();
  }
  PoseSequence truth, moved = {{0, SE3()}};
  double scale = 1;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    truth.push_back({static_cast<TimeNs>(i), graph.vertices[i].world_from_camera});
    if (i == 0) continue;
    const SE3 step = truth[i - 1].world_from_camera.Inverse() * truth[i].world_from_camera *
                     SE3::Exp(sigma * by_camera.head<6>());
    moved.push_back({static_cast<TimeNs>(i), moved.back().world_from_camera *
                                                 SE3(step.rotation(), scale * step.translation())});
    scale *= std::exp(sigma * by_camera[6]);
  }
  const Evaluation evaluation = Evaluate(moved, truth);
  const std::vector<double> expected = ExpectedDrift(graph);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const PosePair& pair = evaluation.aligned_pairs[i];
    const Eigen::Vector3d error =
        pair.estimate_from_camera.translation() - pair.truth_from_camera.translation();
    EXPECT_NEAR(expected[i], error.norm(), 0.02 * expected.front()) << i;
  }
}

TEST(ExpectedDriftTest, HasTheUnitOfTheGraph) {
  PoseGraph graph = Bend(20, Sigma(0.002, 0.0005, 0.001));
  const std::vector<double> expected = ExpectedDrift(graph);
  for (PoseGraphVertex& vertex : graph.vertices) {
    const SE3& pose = vertex.world_from_camera;
    vertex.world_from_camera = SE3(pose.rotation(), 3 * pose.translation());
  }
  for (PoseGraphEdge& edge : graph.edges) edge.covariance.topLeftCorner<3, 3>() *= 9;
  const std::vector<double> scaled = ExpectedDrift(graph);
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(scaled[i], 3 * expected[i], 1e-9);
}

TEST(ExpectedDriftTest, EdgesToEarlierKeyframesAddNothing) {
  PoseGraph graph = Bend(10, Sigma(0.01, 0, 0));
  const std::vector<double> expected = ExpectedDrift(graph);
  for (PoseGraphEdge& edge : graph.edges) {
    if (edge.second == 5) edge.covariance *= 2;
  }
  graph.edges.insert(graph.edges.begin() + 4, {2, 5, SE3(), Matrix7::Identity()});
  EXPECT_THAT(ExpectedDrift(graph), testing::Pointwise(testing::DoubleNear(1e-12), expected));
}

TEST(ExpectedDriftTest, SegmentsAreAlignedApart) {
  PoseGraph graph = Bend(10, Sigma(0.01, 0.001, 0));
  const std::vector<double> first = ExpectedDrift(graph);
  const PoseGraph second = Bend(15, Sigma(0.02, 0.001, 0), 1);
  graph.vertices.insert(graph.vertices.end(), second.vertices.begin(), second.vertices.end());
  graph.edges.insert(graph.edges.end(), second.edges.begin(), second.edges.end());
  std::vector<double> expected = first;
  for (const double sigma : ExpectedDrift(second)) expected.push_back(sigma);
  EXPECT_THAT(ExpectedDrift(graph), testing::Pointwise(testing::DoubleNear(1e-12), expected));
}

TEST(ExpectedDriftTest, NothingIsExpectedOfExactEdgesOrOfNoGraph) {
  EXPECT_THAT(ExpectedDrift(Bend(5, Sigma(0, 0, 0))), testing::Each(0));
  EXPECT_TRUE(ExpectedDrift({}).empty());
  EXPECT_EQ(ExpectedAte({}), 0);
}

TEST(ExpectedDriftTest, FramesHaveThatOfTheKeyframeBefore) {
  const PoseGraph graph = Bend(3, Sigma(0.01, 0, 0));
  const std::vector<double> expected = ExpectedDrift(graph);
  Trajectory trajectory;
  for (int i = 0; i < 9; ++i) {
    FrameResult frame;
    frame.index = i;
    frame.segment = 0;
    if (i != 1) frame.world_from_camera = SE3();
    trajectory.frames.push_back(frame);
  }
  SetExpectedDrift(graph, trajectory);
  EXPECT_EQ(trajectory.frames[1].health.drift_sigma, 0) << "no pose";
  EXPECT_EQ(trajectory.frames[2].health.drift_sigma, expected[0]);
  EXPECT_EQ(trajectory.frames[3].health.drift_sigma, expected[1]);
  EXPECT_EQ(trajectory.frames[8].health.drift_sigma, expected[2]);
  const double mean_square = (2 * expected[0] * expected[0] + 3 * expected[1] * expected[1] +
                              3 * expected[2] * expected[2]) /
                             8;
  EXPECT_DOUBLE_EQ(ExpectedAte(trajectory), std::sqrt(mean_square));
}

}  // namespace
}  // namespace corvo
