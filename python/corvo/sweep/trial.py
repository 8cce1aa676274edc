# SPDX-License-Identifier: MIT
"""One run, in the process that is there for it alone.

Its folder has task.json; result.json is written into it if the run ends by itself.
"""

import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo._corvo import Error, Options, _set_up_logging
from corvo.sweep.downloads import fetch, is_url
from corvo.sweep.measures import Poses, Truth, account
from corvo.sweep.own_process import peak_memory_mb
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.sequence import Frame, Sequence


class Stopwatch:
    """Wall time, and processor time of all threads."""

    def __init__(self) -> None:
        self.wall_s = 0.0
        self.processor_s = 0.0

    def __enter__(self) -> None:
        self._start = (time.perf_counter(), time.process_time())

    def __exit__(self, *_: object) -> None:
        self.wall_s += time.perf_counter() - self._start[0]
        self.processor_s += time.process_time() - self._start[1]


class Trial:
    """An odometry that gets the frames of a sequence."""

    def __init__(self, sequence: Sequence) -> None:
        self._odometry = sequence.odometry()
        self._frames: list[Frame] = []
        self._live: Poses = {}
        self.stopwatch = Stopwatch()

    def process(self, frame: Frame) -> None:
        with self.stopwatch:
            if frame.image is None:
                result = self._odometry.process_missing(frame.time_ns)
            else:
                result = self._odometry.process(frame.image, frame.time_ns, frame.mask)
        if result.world_from_camera is not None and frame.true_time_ns is not None:
            self._live[frame.true_time_ns] = result.world_from_camera
        self._frames.append(Frame(frame.time_ns, frame.true_time_ns, None, None))

    def finish(self, truth: Truth | None) -> dict[str, Any]:
        """Returns the row."""
        with self.stopwatch:
            results = self._odometry.finish().frames
        final: Poses = {}
        rotations: Poses = {}
        for frame, result in zip(self._frames, results, strict=True):
            if frame.true_time_ns is None or result.rotation is None:
                continue
            rotations[frame.true_time_ns] = _pose_of_rotation(result.rotation)
            if result.world_from_camera is not None:
                final[frame.true_time_ns] = result.world_from_camera
        row = account(results)
        return row | truth.compare(final, self._live, rotations) if truth else row


def _pose_of_rotation(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    pose = np.eye(4)
    pose[:3, :3] = rotation
    return pose


def run(task: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Runs a task and returns its row and its times. Raises Error if its input cannot be read."""
    location = task["location"]
    if is_url(location):
        location = str(fetch(location))
    try:
        return _measured(task, location, folder)
    except Error as error:
        # The same message wherever the input lies.
        raise Error(str(error).replace(location, "INPUT")) from None


def _measured(task: dict[str, Any], location: str, folder: Path) -> dict[str, Any]:
    config = folder / "options.yaml"
    config.write_text(str(Options(task["options"])), encoding="utf-8")
    reading = task["reading"] | {"config": str(config)}
    sequence = Sequence(location, reading, task["count"], Perturbation(**task["perturbation"]))
    trial = Trial(sequence)
    for frame in sequence.frames():
        trial.process(frame)
    # The folder of a dataset has more than the file, such as its times.
    truth = task["reading"].get("gt", location)
    row = trial.finish(Truth(truth, task["max_dt_s"]) if sequence.truth_file else None)
    return {"row": row, "times": _times(trial.stopwatch, row["frames"])}


def _times(stopwatch: Stopwatch, frames: int) -> dict[str, float]:
    return {
        "odometry_s": stopwatch.wall_s,
        "processor_s": stopwatch.processor_s,
        "processor_ms_per_frame": 1e3 * stopwatch.processor_s / frames,
        "peak_memory_mb": peak_memory_mb(),
    }


def main(folder: Path) -> None:
    """Executes the task of a folder, and writes the result or the error."""
    task = json.loads((folder / "task.json").read_bytes())
    _set_up_logging()
    try:
        result = run(task, folder)
    except Error as error:
        print(f"corvo: error: {error}", file=sys.stderr)
        result = {"error": str(error)}
    (folder / "result.json").write_text(json.dumps(result), encoding="utf-8")
