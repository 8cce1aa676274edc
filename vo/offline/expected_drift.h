// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/trajectory.h"
#include "vo/map/pose_graph.h"

namespace corvo {

/// Returns, for each vertex, the standard deviation of its position (the root of the sum over the
/// three axes) after the similarity alignment that fits its segment best, in units of the segment:
/// what is expected of the trajectory's error by the covariances of the edges between successive
/// keyframes, to first order. Each edge moves, turns and scales all that follows it. Errors of
/// different edges are independent, but for the error of the camera, which all share. What the
/// covariances do not contain (wrong matches, moving objects, a lens unlike its model) comes on
/// top.
std::vector<double> ExpectedDrift(const PoseGraph& graph);

/// Sets PoseHealth::drift_sigma of all posed frames: that of the keyframe before, or of the first
/// one of the segment. `graph` has the unit of the trajectory.
void SetExpectedDrift(const PoseGraph& graph, Trajectory& trajectory);

/// Returns the root mean square of PoseHealth::drift_sigma over the posed frames: the expected ATE.
double ExpectedAte(const Trajectory& trajectory);

}  // namespace corvo
