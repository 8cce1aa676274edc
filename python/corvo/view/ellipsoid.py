# SPDX-License-Identifier: MIT
"""The ellipsoids of covariances."""

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from corvo.quaternion import quaternion
from corvo.view import colors

SIGMAS_95 = 2.8
"""A normally distributed position is within this many standard deviations with 95% (chi-square
with three degrees of freedom: 2.795)."""


def make_ellipsoid(
    world_from_camera: NDArray[np.float64], covariance: NDArray[np.float64]
) -> rr.Ellipsoids3D:
    """Returns the ellipsoid that holds the position with a probability of 95%.

    Args:
        world_from_camera: Pose of the camera, shape (4, 4).
        covariance: Of [u w] in world_from_camera Exp([u w]), shape (6, 6): u is in the frame of the
            camera.
    """
    variances, axes = np.linalg.eigh(covariance[:3, :3])
    axes[:, 0] *= np.sign(np.linalg.det(axes))
    return rr.Ellipsoids3D(
        centers=[world_from_camera[:3, 3]],
        half_sizes=[SIGMAS_95 * np.sqrt(np.maximum(variances, 0))],
        quaternions=[quaternion(world_from_camera[:3, :3] @ axes)],
        colors=[colors.UNCERTAINTY],
    )
