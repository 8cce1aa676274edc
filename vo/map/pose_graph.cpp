// SPDX-License-Identifier: MIT
#include "vo/map/pose_graph.h"

#include <map>
#include <utility>

namespace corvo {

void ScaleLengths(double scale, PoseGraphEdge::Matrix7& covariance,
                  PoseGraphEdge::Matrix7X& by_camera) {
  covariance.topRows<3>() *= scale;
  covariance.leftCols<3>() *= scale;
  by_camera.topRows<3>() *= scale;
}

PoseGraph WithPosesOf(const Trajectory& trajectory, const std::vector<double>& scales,
                      PoseGraph graph) {
  std::map<KeyframeId, SE3> poses;
  std::map<KeyframeId, double> scale_of;
  std::erase_if(graph.vertices, [&](PoseGraphVertex& vertex) {
    const FrameResult& frame = trajectory.frames[vertex.frame];
    if (!frame.world_from_camera || frame.segment != vertex.segment) return true;
    vertex.world_from_camera = *frame.world_from_camera;
    poses[vertex.keyframe] = vertex.world_from_camera;
    scale_of[vertex.keyframe] = scales[vertex.frame];
    return false;
  });
  std::erase_if(graph.edges, [&](const PoseGraphEdge& edge) {
    return !poses.contains(edge.first) || !poses.contains(edge.second);
  });
  for (PoseGraphEdge& edge : graph.edges) {
    edge.first_from_second = poses.at(edge.first).Inverse() * poses.at(edge.second);
    ScaleLengths(scale_of.at(edge.second), edge.covariance, edge.by_camera);
  }
  return graph;
}

}  // namespace corvo
