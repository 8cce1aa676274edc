// SPDX-License-Identifier: MIT
#include "vo/map/pose_graph.h"

#include <map>
#include <utility>

namespace corvo {

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
    const double scale = scale_of.at(edge.second);
    edge.covariance.topLeftCorner<6, 6>() =
        ScaleCovariance(scale, edge.covariance.topLeftCorner<6, 6>());
    edge.covariance.topRightCorner<3, 1>() *= scale;
    edge.covariance.bottomLeftCorner<1, 3>() *= scale;
  }
  return graph;
}

}  // namespace corvo
