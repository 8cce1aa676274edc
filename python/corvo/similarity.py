# SPDX-License-Identifier: MIT
"""The alignment of a trajectory with its ground truth."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


class Similarity:
    """The transform x_in_truth = scale * R * x_in_estimate + t in the results of evaluate()."""

    def __init__(self, truth_from_estimate: dict[str, Any]) -> None:
        x, y, z, w = truth_from_estimate["quaternion_xyzw"]
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        self.scale = float(truth_from_estimate["scale"])
        self.rotation: NDArray[np.float64] = np.eye(3) + 2 * w * cross + 2 * cross @ cross
        self.translation = np.array(truth_from_estimate["translation"], np.float64)

    def apply(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Returns positions of the estimate, shape (n, 3), in the world of the truth."""
        moved: NDArray[np.float64] = self.scale * positions @ self.rotation.T + self.translation
        return moved

    def apply_inverse(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Returns positions of the truth, shape (n, 3), in the world of the estimate."""
        moved: NDArray[np.float64] = (positions - self.translation) @ self.rotation / self.scale
        return moved
