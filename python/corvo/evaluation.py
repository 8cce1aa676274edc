# SPDX-License-Identifier: MIT
"""The accuracy of a trajectory."""

import json
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from corvo import _corvo
from corvo._corvo import Trajectory
from corvo.result import Result


def evaluate(
    estimate: Trajectory | Result | str | PathLike[str],
    truth: str | PathLike[str] = "",
    *,
    align: str = "sim3",
    max_dt_s: float | None = None,
) -> dict[str, Any]:
    """Compares a trajectory with the ground truth, as `corvo eval --json` does.

    Args:
        estimate: A trajectory, a result, or a file in the format of TUM, KITTI or EuRoC.
        truth: A file or the folder of a dataset; for a result, the ground truth of its run if left
            out.
        align: "sim3", "se3", "scale" or "none".
        max_dt_s: Largest time between poses that are compared, s; half a frame if left out.

    Returns:
        The measures by the names of `corvo eval --json`: ate, rpe_frames, scale_drift and others.

    Raises:
        Error: A file cannot be read, or the trajectories cannot be compared.
    """
    if isinstance(estimate, Result):
        estimate = estimate.folder
    with TemporaryDirectory(prefix="corvo_") as folder:
        if isinstance(estimate, Trajectory):
            file = Path(folder) / "trajectory.tum"
            estimate.write_tum(file)
            estimate = file
        measures: dict[str, Any] = json.loads(
            _corvo._evaluate(estimate, truth, align, max_dt_s).measures
        )
        return measures
