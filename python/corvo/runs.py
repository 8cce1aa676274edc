# SPDX-License-Identifier: MIT
"""Runs of whole sequences, as the command `corvo run` does them, and their results."""

import json
from functools import cached_property
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from corvo import frames
from corvo._corvo import Camera, Options, read_tum
from corvo.commands import Option, execute, option_arguments, write_text

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Result:
    """The result folder of a run. A temporary one is removed with this object."""

    def __init__(
        self, folder: str | PathLike[str], temporary: TemporaryDirectory[str] | None = None
    ) -> None:
        self.folder = Path(folder)
        self._temporary = temporary

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json: outcome, counts, camera, and accuracy given ground truth."""
        summary: dict[str, Any] = json.loads(
            (self.folder / "summary.json").read_text(encoding="utf-8")
        )
        return summary

    @property
    def timestamps_ns(self) -> NDArray[np.int64]:
        """int64 of shape (n,): the times of the posed frames."""
        return self._trajectory[0]

    @property
    def world_from_camera(self) -> NDArray[np.float64]:
        """float64 of shape (n, 4, 4): the poses of the posed frames."""
        return self._trajectory[1]

    @property
    def camera(self) -> Camera:
        """The refined camera with its standard deviations."""
        return Camera.load(self.folder / "camera_estimated.yaml")

    def to_frame(self) -> "pandas.DataFrame":
        """Returns frames.csv, a row for each frame, as a pandas.DataFrame.

        Raises:
            Error: pandas is not installed.
        """
        return frames.to_frame(self._frames_csv)

    def to_arrow(self) -> "pyarrow.Table":
        """Returns frames.csv as a pyarrow.Table.

        Raises:
            Error: pyarrow is not installed.
        """
        return frames.to_arrow(self._frames_csv)

    @cached_property
    def _trajectory(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        return read_tum(self.folder / "trajectory.tum")

    @property
    def _frames_csv(self) -> str:
        return (self.folder / "frames.csv").read_text(encoding="utf-8")


def run(
    input: str | PathLike[str],
    *,
    output: str | PathLike[str] | None = None,
    camera: Camera | str | PathLike[str] | None = None,
    config: Options | str | PathLike[str] | None = None,
    **options: Option,
) -> Result:
    """Runs the odometry on a sequence, as `corvo run` does.

    Args:
        input: A dataset, a folder or pattern of images, or a video, which needs corvo[video].
        output: The folder for the results; a temporary one if left out.
        camera: A camera, or what --camera takes: a calibration file or a shipped camera's name.
        config: Options, or an options file.
        options: Any other option of `corvo run`, with _ for -: focal="auto", refine=True, every=2.

    Ctrl-C ends the run, writes what it has found, and raises KeyboardInterrupt.

    Raises:
        Error: An argument or the input is invalid, or the run ended early.
    """
    temporary = None
    if output is None:
        temporary = TemporaryDirectory(prefix="corvo_")
        output = Path(temporary.name) / "result"
    with TemporaryDirectory(prefix="corvo_") as inputs:
        if isinstance(camera, Camera):
            camera = write_text(Path(inputs), "camera.yaml", camera)
        if isinstance(config, Options):
            config = write_text(Path(inputs), "config.yaml", config)
        given = option_arguments({"camera": camera, "config": config, **options})
        execute(["run", str(input), "--output", str(output), *given])
    return Result(output, temporary)


def export(
    result: Result | str | PathLike[str],
    *,
    to: str,
    output: str | PathLike[str],
    **options: Option,
) -> Path:
    """Writes a result for other programs, as `corvo export` does, and returns the folder.

    Args:
        result: A result, or its folder.
        to: "colmap" or "nerfstudio".
        output: The folder for the export.
        options: Any other option of `corvo export`, with _ for -: images=True, frames="all".

    Raises:
        Error: An argument is invalid, or the result cannot be exported.
    """
    folder = result.folder if isinstance(result, Result) else result
    given = option_arguments({"to": to, "output": output, **options})
    execute(["export", str(folder), *given])
    return Path(output)
