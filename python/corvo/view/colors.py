# SPDX-License-Identifier: MIT
"""The colors of the view, which readers with any color vision can tell apart."""

import numpy as np
from numpy.typing import NDArray

MAX_AGE = 64
"""Tracks of this many frames and more have the same color."""

# From Okabe and Ito, "Color universal design", 2008; the order is that of the command's plots.
_SEGMENTS = [
    (0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (230, 159, 0), (86, 180, 233),
]  # fmt: skip

# Samples of the upper two thirds of the color map "viridis"; darker ones are lost in the image.
_AGES = np.array(
    [(55, 91, 141), (38, 130, 142), (31, 158, 137), (109, 205, 89), (253, 231, 37)], float
)

STATES = {
    "tracking": (0, 158, 115),
    "initializing": (86, 180, 233),
    "rotation_only": (230, 159, 0),
    "lost": (213, 94, 0),
}
TRUTH = (150, 150, 150)
LANDMARKS = (170, 170, 170)
UNCERTAINTY = (204, 121, 167)
MASK = (213, 94, 0)


def segment_color(segment: int) -> tuple[int, int, int]:
    return _SEGMENTS[segment % len(_SEGMENTS)]


def age_colors(ages: NDArray[np.int64]) -> NDArray[np.uint8]:
    """Returns the RGB colors of ages in frames, from blue to yellow on a logarithmic scale.

    Args:
        ages: Shape (n,), at least 1.

    Returns:
        Shape (n, 3).
    """
    share = np.log2(np.minimum(ages, MAX_AGE)) / np.log2(MAX_AGE)
    samples = np.linspace(0, 1, len(_AGES))
    channels = [np.interp(share, samples, channel) for channel in _AGES.T]
    return np.stack(channels, axis=-1).round().astype(np.uint8)
