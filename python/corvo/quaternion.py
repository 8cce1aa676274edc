# SPDX-License-Identifier: MIT
"""Rotations as quaternions."""

import numpy as np
from numpy.typing import NDArray


def quaternion(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns the quaternion x, y, z, w of a rotation, of length 1.

    The outer product of the quaternion with itself is linear in the rotation; its row with the
    largest diagonal element is the quaternion without cancellation.
    """
    r = rotation
    x, y, z, w = 0, 1, 2, 3
    outer = np.empty((4, 4))
    outer[x, x] = 1 + r[0, 0] - r[1, 1] - r[2, 2]
    outer[y, y] = 1 - r[0, 0] + r[1, 1] - r[2, 2]
    outer[z, z] = 1 - r[0, 0] - r[1, 1] + r[2, 2]
    outer[w, w] = 1 + r[0, 0] + r[1, 1] + r[2, 2]
    outer[x, y] = outer[y, x] = r[0, 1] + r[1, 0]
    outer[x, z] = outer[z, x] = r[0, 2] + r[2, 0]
    outer[y, z] = outer[z, y] = r[1, 2] + r[2, 1]
    outer[x, w] = outer[w, x] = r[2, 1] - r[1, 2]
    outer[y, w] = outer[w, y] = r[0, 2] - r[2, 0]
    outer[z, w] = outer[w, z] = r[1, 0] - r[0, 1]
    row = outer[np.argmax(np.diag(outer))]
    unit: NDArray[np.float64] = row / np.sqrt(np.sum(row * row))
    return unit
