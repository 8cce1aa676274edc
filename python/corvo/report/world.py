# SPDX-License-Identifier: MIT
"""The axes in which positions are drawn: to the right, forward and up."""

from typing import NamedTuple

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
