# SPDX-License-Identifier: MIT
"""The axes in which positions are drawn: to the right, forward and up."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Axes(NamedTuple):
    """The coordinate axes of a world as a view from above shows them, without mirroring it."""

    across: int
    along: int
    up: int
    sign: int  # The height is sign * coordinate `up`.

    def apply(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Returns positions, shape (n, 3), as (right, forward, up)."""
        drawn: NDArray[np.float64] = positions[:, [self.across, self.along, self.up]]
        return drawn * [1, 1, self.sign]


def find_axes(rotations: NDArray[np.float64]) -> Axes:
    """Returns the axes of the world of cameras, as the plots of the command have them.

    The vertical is the coordinate axis nearest to the mean of the cameras' y axes.

    Args:
        rotations: Shape (n, 3, 3), world from camera; y points down for n = 0.
    """
    down = rotations[:, :, 1].sum(axis=0) if len(rotations) else np.array([0.0, 1.0, 0.0])
    up = int(np.argmax(np.abs(down)))
    following, last = (up + 1) % 3, (up + 2) % 3
    return Axes(last, following, up, -1) if down[up] > 0 else Axes(following, last, up, 1)


class Similarity:
    """The transform x_in_truth = scale * R * x_in_estimate + t of an evaluation."""

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
