# SPDX-License-Identifier: MIT
"""A result beside its ground truth, as `corvo eval` compares them."""

import json
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo import _corvo
from corvo.result import Result
from corvo.similarity import Similarity

_MIN_POSES = 3
"""Fewer poses cannot be aligned."""


@dataclass(frozen=True)
class Comparison:
    """The errors of poses after the alignment, in the unit of the truth."""

    measures: dict[str, Any]  # As `corvo eval --json`.
    times_ns: NDArray[np.int64]  # Of the compared poses.
    errors: NDArray[np.float64]
    true_positions: NDArray[np.float64]  # Shape (m, 3): while the result has poses.

    @property
    def truth_from_estimate(self) -> Similarity:
        return Similarity(self.measures["truth_from_estimate"])


def compare(result: Result, truth: str | PathLike[str]) -> Comparison | None:
    """Compares a result with a ground truth, or else with that of its run.

    Returns:
        None if the run had none or could not be compared with it, and for less than three poses.

    Raises:
        Error: The ground truth cannot be read or compared.
    """
    max_dt_s = None
    if not truth:
        evaluation = result.summary.get("evaluation")
        if evaluation is None:
            return None
        max_dt_s = evaluation["max_dt_s"]
    if len(result.timestamps_ns) < _MIN_POSES:
        return None
    evaluated = _corvo._evaluate(result.folder, truth, "sim3", max_dt_s)
    times_ns = evaluated.true_timestamps_ns
    is_near = (times_ns >= result.timestamps_ns[0]) & (times_ns <= result.timestamps_ns[-1])
    return Comparison(
        json.loads(evaluated.measures),
        evaluated.timestamps_ns,
        evaluated.errors,
        evaluated.true_positions[is_near],
    )
