# SPDX-License-Identifier: MIT
"""What a page shows of a run."""

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo._corvo import Error
from corvo.report.camera_history import CameraHistory, read_camera_history
from corvo.report.comparison import Comparison, compare
from corvo.report.frames import Frames, Span, find_spans, read_frames
from corvo.report.options import Option, input_options, read_options
from corvo.report.timing import Timing, read_timing
from corvo.report.world import Axes, find_axes
from corvo.result import Result

_Truth = str | PathLike[str]
_METRIC_SOURCES = ("camera_height", "known_distance", "known_size")


@dataclass(frozen=True)
class Run:
    """A result with everything that a page shows of it.

    Arrays over the frames are NaN for frames without a pose. Lengths are in the unit of the truth
    where the run is compared with one, or else in that of the run.
    """

    index: int  # Of num_runs that are shown together; the color depends on it.
    num_runs: int
    name: str
    summary: dict[str, Any]
    frames: Frames
    spans: list[Span]
    positions: NDArray[np.float64]  # Shape (n, 3): right, forward, up.
    distances: NDArray[np.float64]  # Shape (n,): length of the path up to each frame.
    errors: NDArray[np.float64]  # Shape (n,): after the alignment; NaN also without truth.
    drift_sigma: NDArray[np.float64]  # Shape (n,): expected of these errors.
    relative_sigma: NDArray[np.float64]  # Shape (n,): of the position, to the reference keyframe.
    relative_sigma_deg: NDArray[np.float64]  # Shape (n,): of the rotation.
    unit: str
    comparison: Comparison | None
    true_path: NDArray[np.float64] | None  # Shape (m, 3): right, forward, up.
    camera_history: CameraHistory | None
    timing: Timing
    options: dict[str, Option]
    inputs: dict[str, str]
    mask_png: bytes | None  # Where the last image was masked.

    @property
    def is_alone(self) -> bool:
        return self.num_runs == 1

    @property
    def path_length(self) -> float:
        is_known = np.isfinite(self.distances)
        return float(self.distances[is_known][-1]) if is_known.any() else 0.0

    @property
    def posed_segments(self) -> list[int]:
        return sorted({int(s) for s in self.frames.segments[self.frames.is_posed]})


def open_runs(results: Sequence[Result], truth: _Truth) -> list[Run]:
    """Reads results and compares them with the ground truth. Raises Error if one cannot be read."""
    if not results:
        raise Error("there is no result to report about")
    runs: list[Run] = []
    axes: dict[bytes, Axes] = {}  # By the true positions: all runs of a truth are drawn alike.
    names = _names([result.folder for result in results])
    for index, result in enumerate(results):
        try:
            runs.append(_open(result, index, names, truth, axes))
        except (KeyError, TypeError, ValueError, OSError) as error:
            if isinstance(error, Error):
                raise
            raise Error(f"{result.folder}: is not the result of a run ({error!r})") from None
    return runs


def in_units(runs: Sequence[Run]) -> list[list[Run]]:
    """Returns the runs with poses, those of each unit together: only they fit in one plot."""
    posed = [run for run in runs if run.posed_segments]
    units = dict.fromkeys(run.unit for run in posed)
    return [[run for run in posed if run.unit == unit] for unit in units]


def _open(
    result: Result, index: int, names: list[str], truth: _Truth, axes: dict[bytes, Axes]
) -> Run:
    frames, comparison = read_frames(result), compare(result, truth)
    scale = comparison.truth_from_estimate.scale if comparison else 1.0
    world = _axes_of(result, comparison, axes)
    positions = world.apply(_positions(result, frames, comparison))
    translation_sigma, rotation_sigma = _relative_sigmas(result, len(frames))
    return Run(
        index=index,
        num_runs=len(names),
        name=names[index],
        summary=result.summary,
        frames=frames,
        spans=find_spans(frames),
        positions=positions,
        distances=_distances(positions, frames),
        errors=_errors(result, frames, comparison),
        drift_sigma=scale * frames.drift_sigma,
        relative_sigma=scale * translation_sigma,
        relative_sigma_deg=np.degrees(rotation_sigma),
        unit="m" if comparison or _is_metric(result.summary) else "units",
        comparison=comparison,
        true_path=world.apply(comparison.true_positions) if comparison else None,
        camera_history=read_camera_history(result),
        timing=read_timing(result),
        options=read_options(result),
        inputs=input_options(result),
        mask_png=_mask(result),
    )


def _mask(result: Result) -> bytes | None:
    file = result.folder / "mask.png"
    return file.read_bytes() if file.is_file() else None


def _names(folders: list[Path]) -> list[str]:
    """Returns the names of the folders, or their paths if two names are equal."""
    names = [folder.resolve().name for folder in folders]
    return names if len(set(names)) == len(names) else [str(folder) for folder in folders]


def _is_metric(summary: dict[str, Any]) -> bool:
    if "meters_per_unit" in summary:
        return True
    sources = [segment["scale"]["from"] for segment in summary["segments"]]
    return bool(sources) and all(source in _METRIC_SOURCES for source in sources)


def _axes_of(result: Result, comparison: Comparison | None, axes: dict[bytes, Axes]) -> Axes:
    rotations = result.world_from_camera[:, :3, :3]
    if comparison is None:
        return find_axes(rotations)
    key = comparison.true_positions.tobytes()
    turn = comparison.truth_from_estimate.rotation
    return axes.setdefault(key, find_axes(turn @ rotations))


def _positions(
    result: Result, frames: Frames, comparison: Comparison | None
) -> NDArray[np.float64]:
    """Returns positions of all frames, NaN without a pose, in the world of the truth if known."""
    positions = result.world_from_camera[:, :3, 3]
    if comparison is not None:
        positions = comparison.truth_from_estimate.apply(positions)
    if len(positions) != frames.is_posed.sum():
        raise Error(f"{result.file('frames.csv')}: is not that of the trajectory")
    return _at_posed(frames, positions)


def _distances(positions: NDArray[np.float64], frames: Frames) -> NDArray[np.float64]:
    """Returns the length of the path up to each frame, without the steps between segments."""
    posed, segments = positions[frames.is_posed], frames.segments[frames.is_posed]
    if len(posed) == 0:
        return np.full(len(frames), np.nan)
    steps = np.linalg.norm(np.diff(posed, axis=0), axis=1)
    steps[np.diff(segments) != 0] = 0
    return _at_posed(frames, np.concatenate([[0.0], np.cumsum(steps)]))


def _errors(
    result: Result, frames: Frames, comparison: Comparison | None
) -> NDArray[np.float64]:
    if comparison is None:
        return np.full(len(frames), np.nan)
    errors = dict(zip(comparison.times_ns.tolist(), comparison.errors.tolist()))
    posed = [errors.get(time_ns, np.nan) for time_ns in result.timestamps_ns.tolist()]
    return _at_posed(frames, np.array(posed, np.float64))


def _at_posed(frames: Frames, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns values of the posed frames, shape (p, ...), as values of all: shape (n, ...)."""
    spread = np.full((len(frames), *values.shape[1:]), np.nan)
    spread[frames.is_posed] = values
    return spread


def _relative_sigmas(
    result: Result, num_frames: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Returns the standard deviations of relative poses, translation and rotation (rad).

    Each is the root of the sum of the variances along the three axes.
    """
    sigmas = np.full((2, num_frames), np.nan)
    for row in result.read_table("relative_poses.csv"):
        variances = [float(row[f"c{i}{i}"]) for i in range(6)]
        sigmas[:, int(row["index"])] = np.sqrt([sum(variances[:3]), sum(variances[3:])])
    return sigmas[0], sigmas[1]
