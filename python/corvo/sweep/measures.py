# SPDX-License-Identifier: MIT
"""The accuracy and completeness of a run, by the columns of rows.parquet. Unknown ones are None."""

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo import _corvo
from corvo._corvo import Error, FrameResult
from corvo.quaternion import quaternion

Poses = dict[int, NDArray[np.float64]]
"""world_from_camera, shape (4, 4), by the time of the truth in ns."""

_MIN_POSES = 3
"""Fewer poses cannot be aligned."""


def account(frames: list[FrameResult]) -> dict[str, Any]:
    """Returns what is known without ground truth."""
    is_posed = [frame.world_from_camera is not None for frame in frames]
    reasons = Counter(f.reason for f, posed in zip(frames, is_posed) if not posed)
    return {
        "frames": len(frames),
        "posed_share": sum(is_posed) / len(frames),
        "rotation_share": sum(frame.rotation is not None for frame in frames) / len(frames),
        "segments": len({f.segment for f, posed in zip(frames, is_posed) if posed}),
        "losses": sum(before and not after for before, after in zip(is_posed, is_posed[1:])),
        "reason": min(reasons, key=lambda name: (-reasons[name], name)) if reasons else None,
    }


class Truth:
    """A ground truth with which trajectories are compared.

    Args:
        path: A file or the folder of a dataset.
        max_dt_s: Largest time between poses that are compared; half a frame if None.
    """

    def __init__(self, path: str, max_dt_s: float | None) -> None:
        self._path = path
        self._max_dt_s = max_dt_s

    def compare(self, final: Poses, live: Poses, rotations: Poses) -> dict[str, Any]:
        """Returns the errors of the final poses, of the live ones, and of rotations."""
        found = self._evaluate(final, "sim3")
        relative, drift = found.get("rpe_frames", {}), found.get("scale_drift", {})
        kitti = found.get("kitti", {})
        return {
            "coverage": found.get("coverage", 0.0),
            "ate": found.get("ate", {}).get("rmse"),
            "ate_percent": found.get("ate", {}).get("percent_of_path"),
            "live_ate": self._evaluate(live, "sim3").get("ate", {}).get("rmse"),
            "rpe": relative.get("translation", {}).get("rmse"),
            "rpe_deg": relative.get("rotation_deg", {}).get("rmse"),
            "rotation_deg": self._rotation_error(rotations),
            "t_rel_percent": kitti.get("t_rel_percent"),
            "r_rel_deg_per_100m": kitti.get("r_rel_deg_per_100m"),
            "scale_drift": drift.get("last_over_first"),
            "scale_percent_per_km": drift.get("percent_per_km"),
        }

    def _rotation_error(self, rotations: Poses) -> float | None:
        error = self._evaluate(rotations, "none").get("rpe_time", {})
        degrees: float | None = error.get("rotation_deg", {}).get("rmse")
        return degrees

    def _evaluate(self, poses: Poses, align: str) -> dict[str, Any]:
        """Returns the measures of `corvo eval`, or nothing if the poses cannot be aligned."""
        if len(poses) < _MIN_POSES:
            return {}
        with TemporaryDirectory(prefix="corvo_") as folder:
            file = Path(folder) / "poses.tum"
            file.write_text("".join(_tum_lines(poses)))
            try:
                found = _corvo._evaluate(file, self._path, align, self._max_dt_s)
            except Error:
                return {}
        measures: dict[str, Any] = json.loads(found.measures)
        return measures


def _tum_lines(poses: Poses) -> Iterable[str]:
    for time_ns, pose in sorted(poses.items()):
        values = [*pose[:3, 3], *quaternion(pose[:3, :3])]
        seconds, nanoseconds = divmod(time_ns, 10**9)
        yield f"{seconds}.{nanoseconds:09} {' '.join(repr(float(value)) for value in values)}\n"
