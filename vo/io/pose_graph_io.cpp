// SPDX-License-Identifier: MIT
#include "vo/io/pose_graph_io.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>

namespace corvo {
namespace {

/// Returns " tx ty tz qx qy qz qw", followed by the scale 1 if it is part of the form.
std::string Pose(const SE3& pose, G2oForm form) {
  const SE3::Data d = pose.data();
  return fmt::format(" {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g}{}", d[4], d[5], d[6],
                     d[0], d[1], d[2], d[3], form == G2oForm::kSim3 ? " 1" : "");
}

/// Returns the information of the first `size` components. The smallest variances are limited, so
/// that it is finite: the unit of a segment is exact by definition.
Eigen::MatrixXd Information(const PoseGraphEdge& edge, int size) {
  constexpr double kSmallest = 1e-12;  // Relative to the mean variance of the same kind.
  Eigen::MatrixXd covariance = edge.covariance.topLeftCorner(size, size);
  for (const int begin : {0, 3}) {
    const double mean = covariance.diagonal().segment<3>(begin).mean();
    covariance.diagonal().segment<3>(begin).array() += kSmallest * mean + 1e-30;
  }
  return covariance.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
}

std::string UpperTriangle(const Eigen::MatrixXd& matrix) {
  std::string text;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = row; column < matrix.cols(); ++column) {
      text += fmt::format(" {:.9g}", matrix(row, column));
    }
  }
  return text;
}

}  // namespace

std::string ToG2o(const PoseGraph& graph, G2oForm form) {
  const int size = form == G2oForm::kSim3 ? 7 : 6;
  const std::string type = form == G2oForm::kSim3 ? "SIM3:QUAT" : "SE3:QUAT";
  std::string text;
  for (const PoseGraphVertex& vertex : graph.vertices) {
    text += fmt::format("VERTEX_{} {}{}\n", type, vertex.keyframe,
                        Pose(vertex.world_from_camera, form));
  }
  for (const PoseGraphEdge& edge : graph.edges) {
    text += fmt::format("EDGE_{} {} {}{}{}\n", type, edge.first, edge.second,
                        Pose(edge.first_from_second, form), UpperTriangle(Information(edge, size)));
  }
  return text;
}

}  // namespace corvo
