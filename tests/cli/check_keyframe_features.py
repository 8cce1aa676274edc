# SPDX-License-Identifier: MIT
"""Checks that keyframe_features.npy belongs to the pose graph and observations of a result.

usage: check_keyframe_features.py RESULT
"""
import sys

import numpy as np

result = sys.argv[1]
features = np.load(f"{result}/keyframe_features.npy")
observations = np.load(f"{result}/observations.npy")
with open(f"{result}/pose_graph.g2o") as graph:
    vertices = [int(line.split()[1]) for line in graph if line.startswith("VERTEX")]

assert sorted(set(features["keyframe"])) == vertices, "every vertex of the graph has features"
assert np.all(np.diff(features["keyframe"].astype(int)) >= 0)
assert features["descriptor"].shape == (len(features), 32)
assert len(np.unique(features["descriptor"], axis=0)) > 0.9 * len(features)
assert features["octave"].max() < 8 and features["angle"].max() < 360

# Features that observe a landmark lie where observations.npy has it.
num_compared = num_near = 0
for keyframe in vertices:
    rows = features[(features["keyframe"] == keyframe) & (features["landmark"] >= 0)]
    seen = observations[observations["frame"] == rows["frame"][0]]
    pixels = {o["landmark"]: np.array([o["x"], o["y"]]) for o in seen}
    for row in rows:
        if row["landmark"] not in pixels:
            continue
        num_compared += 1
        offset = pixels[row["landmark"]] - [row["x"], row["y"]]
        num_near += np.linalg.norm(offset) < 2 * 1.2 ** row["octave"]
assert num_compared > 500, num_compared
assert num_near > 0.95 * num_compared, (num_near, num_compared)
