# SPDX-License-Identifier: MIT
"""How the estimate of the camera changed while a run went on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from corvo.result import Result

_FILE = "camera_history.csv"
_SIGMA = "_sigma"


class CameraHistory(NamedTuple):
    """Estimates of the camera, the first of which is the given camera. Arrays have shape (n,)."""

    frames: NDArray[np.int64]
    """After which each held first."""
    values: dict[str, NDArray[np.float64]]
    """By the names of the parameters."""
    sigmas: dict[str, NDArray[np.float64]]
    """The standard deviations of the values."""

    @property
    def changed(self) -> list[str]:
        """The parameters that did not keep their given value."""
        return [name for name, values in self.values.items() if np.ptp(values) > 0]


def read_camera_history(result: Result) -> CameraHistory | None:
    """Returns None if the camera was not estimated, or by a version that did not write this."""
    if not (result.folder / _FILE).exists():
        return None
    rows = result.read_table(_FILE)
    columns = {name: np.array([float(row[name]) for row in rows], np.float64) for name in rows[0]}
    names = [name for name in columns if name + _SIGMA in columns]
    return CameraHistory(
        columns["index"].astype(np.int64),
        {name: columns[name] for name in names},
        {name: columns[name + _SIGMA] for name in names},
    )
