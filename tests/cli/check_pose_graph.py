#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads a pose graph with GTSAM, adds a loop to it and closes the loop.

The loop says that the last keyframe is 2% of the path farther to the right of the first one than the
graph has it. Prints JSON: the numbers of vertices and edges, the error of the graph as it is, and
the distance of the last keyframe from its place in the loop, and its motion, both in units of the
displacement.

usage: check_pose_graph.py pose_graph.g2o
"""
import json
import sys

import gtsam
import numpy as np


def main():
    graph, initial = gtsam.readG2o(sys.argv[1], True)
    keys = sorted(initial.keys())
    poses = [initial.atPose3(key) for key in keys]
    path = sum(np.linalg.norm(b.translation() - a.translation()) for a, b in zip(poses, poses[1:]))
    error = graph.error(initial)
    num_edges = graph.size()
    graph.add(gtsam.PriorFactorPose3(keys[0], poses[0],
                                     gtsam.noiseModel.Isotropic.Sigma(6, 1e-9 * path)))
    displacement = np.array([0.02 * path, 0, 0])
    loop = poses[0].between(poses[-1])
    loop = gtsam.Pose3(loop.rotation(), loop.translation() + displacement)
    sigmas = np.r_[np.full(3, 1e-3), np.full(3, 1e-6 * path)]
    graph.add(gtsam.BetweenFactorPose3(keys[0], keys[-1], loop,
                                       gtsam.noiseModel.Diagonal.Sigmas(sigmas)))
    closed = gtsam.LevenbergMarquardtOptimizer(graph, initial).optimize()
    last = closed.atPose3(keys[0]).between(closed.atPose3(keys[-1])).translation()
    moved = [np.linalg.norm(closed.atPose3(key).translation() - pose.translation())
             for key, pose in zip(keys, poses)]
    unit = np.linalg.norm(displacement)
    print(json.dumps({"vertices": len(keys), "edges": num_edges, "error": error,
                      "left": float(np.linalg.norm(last - loop.translation())) / unit,
                      "moved_last": float(moved[-1]) / unit,
                      "moved_middle": float(moved[len(moved) // 2]) / unit}))


if __name__ == "__main__":
    main()
