// SPDX-License-Identifier: MIT
// Compares the stated covariances of the pose graph, chained over several keyframes, with their
// errors on rendered sequences.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Cholesky>

#include "apps/synthetic/sequence.h"
#include "tests/support/data.h"
#include "vo/odometry.h"

namespace corvo {
namespace {

using synthetic::Sequence;
using Matrix7 = PoseGraphEdge::Matrix7;

constexpr int kUnitKeyframes = 5;  // Keyframes to either side that the unit is measured with.

/// The keyframes of a run with their true poses, and the edge of each to the one before it.
struct KeyframeChain {
  std::vector<SE3> estimate, truth;
  std::vector<Matrix7> covariances;

  int size() const { return static_cast<int>(estimate.size()); }
};

KeyframeChain ChainOf(const PoseGraph& graph, const Sequence& sequence, int first_frame) {
  KeyframeChain chain;
  std::map<KeyframeId, int> num_edges;
  std::map<KeyframeId, Matrix7> newest;
  for (const PoseGraphEdge& edge : graph.edges) {
    ++num_edges[edge.second];
    newest[edge.second] = edge.covariance;  // That to the keyframe before comes last.
  }
  for (const PoseGraphVertex& vertex : graph.vertices) {
    chain.estimate.push_back(vertex.world_from_camera);
    chain.truth.push_back(sequence.poses()[first_frame + vertex.frame].world_from_camera);
    const bool is_first = num_edges[vertex.keyframe] == 0;
    chain.covariances.push_back(
        is_first ? Matrix7::Zero() : Matrix7(newest[vertex.keyframe] / num_edges[vertex.keyframe]));
  }
  return chain;
}

KeyframeChain Track(int first_frame, int num_frames) {
  synthetic::SequenceOptions options;
  options.width = 620;
  options.noise_sigma = 3;
  options.noise_seed = first_frame + 4;
  options.frames = first_frame + num_frames;
  const Sequence sequence = synthetic::MakeStreet(options);
  OdometryOptions odometry_options;
  odometry_options.calibration.enabled = false;
  Odometry odometry(sequence.camera(), odometry_options);
  for (int i = first_frame; i < sequence.size(); ++i) {
    odometry.Process(sequence.Render(i), sequence.poses()[i].time_ns);
  }
  odometry.Finish();
  return ChainOf(odometry.GetPoseGraph(), sequence, first_frame);
}

/// Returns the spread of the positions around a keyframe.
double Spread(const std::vector<SE3>& poses, int keyframe) {
  Eigen::Matrix3Xd positions(3, 2 * kUnitKeyframes + 1);
  for (int i = 0; i < positions.cols(); ++i) {
    positions.col(i) = poses[keyframe - kUnitKeyframes + i].translation();
  }
  positions.colwise() -= positions.rowwise().mean().eval();
  return positions.norm();
}

/// Returns the true length of the unit at a keyframe.
double UnitAt(const KeyframeChain& chain, int keyframe) {
  return Spread(chain.truth, keyframe) / Spread(chain.estimate, keyframe);
}

/// Returns how the error of the edge to keyframe `b` moves [υ ω λ] of the later keyframe `n`.
Matrix7 Propagation(const KeyframeChain& chain, int b, int n) {
  const SE3 later_from_b = chain.estimate[n].Inverse() * chain.estimate[b];
  Matrix7 moved = Matrix7::Identity();
  moved.topLeftCorner<6, 6>() = later_from_b.Adjoint();
  moved.topRightCorner<3, 1>() = -later_from_b.translation();
  return moved;
}

/// The mean squares of errors over a horizon, in units of their variance.
struct MeanSquares {
  double pose = 0;       ///< Squared Mahalanobis distance, of six degrees of freedom.
  double log_scale = 0;  ///< Of λ.
};

MeanSquares Measure(const std::vector<KeyframeChain>& chains, int horizon) {
  MeanSquares sum;
  int count = 0;
  for (const KeyframeChain& chain : chains) {
    for (int a = kUnitKeyframes; a + horizon + kUnitKeyframes < chain.size(); ++a, ++count) {
      const int n = a + horizon;
      const double unit = UnitAt(chain, a), log_scale = std::log(UnitAt(chain, n) / unit);
      const SE3 truth = chain.truth[a].Inverse() * chain.truth[n];
      const SE3 scaled(truth.rotation(), truth.translation() / unit);
      const SE3::Tangent error =
          ((chain.estimate[a].Inverse() * chain.estimate[n]).Inverse() * scaled).Log();
      Matrix7 covariance = Matrix7::Zero();
      for (int b = a + 1; b <= n; ++b) {
        const Matrix7 moved = Propagation(chain, b, n);
        covariance += moved * chain.covariances[b] * moved.transpose();
      }
      const SE3::Matrix6 of_pose = covariance.topLeftCorner<6, 6>();
      sum.pose += error.dot(of_pose.ldlt().solve(error));
      sum.log_scale += log_scale * log_scale / covariance(6, 6);
    }
  }
  return {sum.pose / count, sum.log_scale / count};
}

TEST(PoseGraphCovarianceTest, CoversTheErrorsOfChainsAndTheDriftOfTheScale) {
  CORVO_SKIP_IF_SHORT();
  const std::vector<KeyframeChain> chains = {Track(0, 150), Track(200, 150), Track(400, 150)};
  for (const int horizon : {1, 5, 10}) {
    const MeanSquares squares = Measure(chains, horizon);
    ::testing::Test::RecordProperty("pose_" + std::to_string(horizon),
                                    std::to_string(squares.pose));
    ::testing::Test::RecordProperty("log_scale_" + std::to_string(horizon),
                                    std::to_string(squares.log_scale));
    EXPECT_GT(squares.pose, 3) << horizon;
    EXPECT_LT(squares.pose, 8) << horizon;
  }
  // With the keyframes that hand the scale on taken as exact, the mean is about 3.
  const double log_scale = Measure(chains, 10).log_scale;
  EXPECT_GT(log_scale, 0.4);
  EXPECT_LT(log_scale, 2);
}

}  // namespace
}  // namespace corvo
