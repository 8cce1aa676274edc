# SPDX-License-Identifier: MIT
"""The result folder of a run."""

import csv
import io
import json
from functools import cached_property
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from corvo import frames
from corvo._corvo import Camera, Error, read_tum

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Result:
    """The result folder of a run. A temporary one is removed with this object.

    The files are read when they are first needed. The arrays of the posed frames have equal
    indices.

    Raises:
        Error: A file is missing, when it is read; or malformed, where the members say so.
    """

    def __init__(
        self, folder: str | PathLike[str], temporary: TemporaryDirectory[str] | None = None
    ) -> None:
        self.folder = Path(folder)
        self._temporary = temporary

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json: outcome, counts, camera, and accuracy given ground truth."""
        try:
            summary: dict[str, Any] = json.loads(self._read_text("summary.json"))
        except json.JSONDecodeError as error:
            raise Error(f"{self.folder / 'summary.json'}: {error}") from None
        return summary

    @property
    def timestamps_ns(self) -> NDArray[np.int64]:
        """int64 of shape (n,): the times of the posed frames."""
        return self._trajectory[0]

    @property
    def world_from_camera(self) -> NDArray[np.float64]:
        """float64 of shape (n, 4, 4): the poses of the posed frames."""
        return self._trajectory[1]

    @cached_property
    def orientations(self) -> NDArray[np.float64]:
        """float64 of shape (n, 4): the rotations of these poses as quaternions x, y, z, w."""
        lines = self._read_text("trajectory.tum").splitlines()
        rows = [line.split()[4:] for line in lines if not line.startswith("#")]
        return np.array(rows, np.float64).reshape(-1, 4)

    @cached_property
    def segments(self) -> NDArray[np.int64]:
        """int64 of shape (n,): the segments of the posed frames.

        Raises:
            Error: frames.csv is malformed or not that of the trajectory.
        """
        table, num_poses = self.file("frames.csv"), len(self.timestamps_ns)
        try:
            segments = [int(row["segment"]) for row in self.rows if row["posed"] == "1"]
        except (KeyError, ValueError) as error:
            raise Error(f"{table}: is no table of frames ({error!r})") from None
        if len(segments) != num_poses:
            raise Error(f"{table}: {len(segments)} frames are posed; {num_poses} have a pose")
        return np.array(segments, np.int64)

    @cached_property
    def rows(self) -> list[dict[str, str]]:
        """frames.csv: the texts of each frame by the names of their columns."""
        return self.read_table("frames.csv")

    @property
    def camera(self) -> Camera:
        """The refined camera with its standard deviations."""
        return Camera.load(self.file("camera_estimated.yaml"))

    def to_frame(self) -> "pandas.DataFrame":
        """Returns frames.csv, a row for each frame, as a pandas.DataFrame.

        Raises:
            Error: pandas is not installed.
        """
        return frames.to_frame(self._read_text("frames.csv"))

    def to_arrow(self) -> "pyarrow.Table":
        """Returns frames.csv as a pyarrow.Table.

        Raises:
            Error: pyarrow is not installed.
        """
        return frames.to_arrow(self._read_text("frames.csv"))

    def file(self, name: str) -> Path:
        """Returns the path of a file of the folder. Raises Error if it is not there."""
        file = self.folder / name
        if not file.is_file():
            raise Error(f"{self.folder}: is not the result of a run; it has no {name}")
        return file

    def read_table(self, name: str) -> list[dict[str, str]]:
        """Reads a table (.csv) of the folder: the texts of each row by the names of the columns."""
        return list(csv.DictReader(io.StringIO(self._read_text(name))))

    @cached_property
    def _trajectory(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        return read_tum(self.file("trajectory.tum"))

    def _read_text(self, name: str) -> str:
        return self.file(name).read_text(encoding="utf-8")
