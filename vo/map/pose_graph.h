// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A keyframe of a pose graph.
struct PoseGraphVertex {
  KeyframeId keyframe = kNoId;
  int frame = kNoId;  ///< Index of its input frame.
  int segment = 0;
  SE3 world_from_camera;
};

/// The pose of a keyframe relative to an earlier one of its segment, in the unit of the segment.
struct PoseGraphEdge {
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  using Matrix7X = Eigen::Matrix<double, 7, Eigen::Dynamic>;

  KeyframeId first = kNoId;   ///< The earlier keyframe.
  KeyframeId second = kNoId;  ///< The later keyframe.
  SE3 first_from_second;
  /// Covariance of the error [υ ω λ]: the pose is first_from_second * Exp([υ ω]), and λ is the
  /// logarithm of the unit of length at the second keyframe in that at the first: the drift of the
  /// scale between them.
  Matrix7 covariance = Matrix7::Zero();
  /// How the error depends on that of the camera's parameters, which all edges share. No columns,
  /// if that is not known.
  Matrix7X by_camera = Matrix7X(7, 0);
};

/// The keyframes of a sequence and how well their relative poses are known, for a back end that
/// adds loops. The edges agree with the poses of the vertices, since these are the result of the
/// same observations. Each keyframe has an edge to the one before it and some to others that
/// observe the same landmarks; all of these depend on the same observations, so that the covariance
/// of each of the n edges to earlier keyframes counts n times (covariance intersection with equal
/// weights: Julier and Uhlmann, A non-divergent estimation algorithm in the presence of unknown
/// correlations, ACC 1997). There is no edge between segments.
struct PoseGraph {
  std::vector<PoseGraphVertex> vertices;  ///< In ascending order of keyframes.
  std::vector<PoseGraphEdge> edges;       ///< In ascending order of `second`, then `first`.
  /// Covariance of the error of the newest estimate of the camera, a row for each free parameter.
  Eigen::MatrixXd camera_covariance;
};

/// Expresses an edge's covariance, and how its error depends on the camera, in another unit of
/// length: lengths are multiplied by `scale`.
void ScaleLengths(double scale, PoseGraphEdge::Matrix7& covariance,
                  PoseGraphEdge::Matrix7X& by_camera);

/// Returns a graph with the poses of a trajectory of the same sequence, such as a refined one,
/// whose unit of length at frame i is 1 / `scales[i]` of that of the graph. Keyframes without a
/// pose of their segment there are left out.
PoseGraph WithPosesOf(const Trajectory& trajectory, const std::vector<double>& scales,
                      PoseGraph graph);

}  // namespace corvo
