# SPDX-License-Identifier: MIT
"""Intervals in which medians lie, by resampling what was measured (Efron, 1979)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_SAMPLES = 2000
_SEED = 1
_LEVELS = (0.025, 0.975)


class Interval(NamedTuple):
    low: float
    high: float


def median_interval(values: Sequence[float]) -> Interval:
    """Returns the 95% interval of the median of values, of which some may be infinite."""
    measured = np.array(values, np.float64)
    random = np.random.RandomState(_SEED)
    chosen = random.randint(0, len(measured), (_SAMPLES, len(measured)))
    return _interval(np.median(measured[chosen], axis=1))


def grouped_median_interval(groups: Sequence[Sequence[float]]) -> Interval:
    """Returns the 95% interval of the median of all values if whole groups are resampled.

    The values of a group, such as the runs of one sequence, may depend on each other.
    """
    arrays = [np.array(group, np.float64) for group in groups]
    random = np.random.RandomState(_SEED)
    chosen = random.randint(0, len(arrays), (_SAMPLES, len(arrays)))
    medians = [np.median(np.concatenate([arrays[i] for i in sample])) for sample in chosen]
    return _interval(np.array(medians))


def _interval(medians: NDArray[np.float64]) -> Interval:
    ordered = np.sort(medians)  # Infinite ones cannot be interpolated.
    low, high = (float(ordered[int(level * (len(ordered) - 1))]) for level in _LEVELS)
    return Interval(low, high)
