// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vo/map/pose_graph.h"

namespace corvo {

/// The types of a g2o file's vertices and edges.
enum class G2oForm {
  kSe3,   ///< VERTEX_SE3:QUAT and EDGE_SE3:QUAT, 6 degrees of freedom.
  kSim3,  ///< VERTEX_SIM3:QUAT and EDGE_SIM3:QUAT, 7: the scale may drift.
};

/// Returns a pose graph in g2o's text format (Kuemmerle et al., g2o: A general framework for graph
/// optimization, ICRA 2011). Vertices are named by KeyframeId. The upper triangle of the
/// information is that of [υ ω] or [υ ω λ] in the axes of the second keyframe, with ω in rad, as
/// GTSAM and Ceres' pose_graph_3d read it; g2o itself takes ω / 2.
std::string ToG2o(const PoseGraph& graph, G2oForm form);

}  // namespace corvo
