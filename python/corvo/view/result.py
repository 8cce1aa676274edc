# SPDX-License-Identifier: MIT
"""Reads the folder of a finished run and logs it as if it were running."""

import csv
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import corvo
from corvo.view.recorder import Intrinsics, Recorder

_PLY_POINT = np.dtype(
    [
        ("position", "<f8", 3),
        ("rgb", "u1", 3),
        ("id", "<i4"),
        ("segment", "<i4"),
        ("observations", "<i4"),
    ]
)


@dataclass(frozen=True)
class RelativePose:
    """The covariance of a frame relative to a keyframe."""

    covariance: NDArray[np.float64]


@dataclass(frozen=True)
class ResultFrame:
    """A frame of a finished run, with its final pose. See corvo.ProcessedFrame."""

    index: int
    timestamp_ns: int
    state: str
    reason: str
    segment: int | None
    is_keyframe: bool
    world_from_camera: NDArray[np.float64] | None
    relative_pose: RelativePose | None
    num_matches: int
    num_inliers: int
    parallax_deg: float
    keypoints: NDArray[np.float64]
    landmarks: NDArray[np.int64]
    image_file: Path | None
    latency_ms: float | None


class Result:
    """The folder that `corvo run` has written.

    Raises:
        Error: A file is missing or malformed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        if not (folder / "frames.csv").is_file():
            raise corvo.Error(f"{folder}: is not the result of a run; it has no frames.csv")
        self.summary: dict[str, Any] = json.loads((folder / "summary.json").read_text())
        self._rows = self._read_table("frames.csv")
        times, poses = corvo.read_tum(folder / "trajectory.tum")
        self._poses = dict(zip(times.tolist(), poses))
        self._covariances = {
            int(row["index"]): _covariance(row) for row in self._read_table("relative_poses.csv")
        }
        observations = np.load(folder / "observations.npy")
        order = np.argsort(observations["frame"], kind="stable")
        self._observations = observations[order]

    @property
    def intrinsics(self) -> Intrinsics:
        return Intrinsics.of(corvo.Camera.load(self._folder / "camera_estimated.yaml"))

    def __len__(self) -> int:
        return len(self._rows)

    def frames(self) -> Iterator[ResultFrame]:
        """Yields the frames in the order of their images."""
        latencies = [float(row["total_ms"]) for row in self._read_table("timing.csv")]
        numbers = self._observations["frame"]
        for row, latency_ms in zip(self._rows, latencies, strict=True):
            index = int(row["index"])
            first, last = np.searchsorted(numbers, [index, index + 1])
            yield self._frame(row, self._observations[first:last], latency_ms)

    def new_landmarks(self) -> dict[int, tuple[NDArray[np.float64], NDArray[np.uint8]]]:
        """Returns the positions and colors of the landmarks by the keyframe that shows them.

        A landmark is shown at the first keyframe from its first observation on; without one, at the
        last keyframe.
        """
        points = _read_map(self._folder / "map.ply")
        keyframes = np.array([int(row["index"]) for row in self._rows if row["keyframe"] == "1"])
        if len(keyframes) == 0:
            return {}
        ids, rows = np.unique(self._observations["landmark"], return_index=True)
        first_frames = dict(zip(ids.tolist(), self._observations["frame"][rows].tolist()))
        seen = np.array([first_frames.get(id, 0) for id in points["id"].tolist()])
        shown = np.minimum(np.searchsorted(keyframes, seen), len(keyframes) - 1)
        return {
            int(keyframe): (points["position"][shown == i], points["rgb"][shown == i])
            for i, keyframe in enumerate(keyframes)
        }

    def truth(self) -> NDArray[np.float64] | None:
        """Returns the true path in the world of the trajectory, shape (n, 3), if it is known."""
        file = self._folder / "groundtruth.tum"
        evaluation = self.summary.get("evaluation")
        if evaluation is None or not file.is_file():
            return None
        positions = corvo.read_tum(file)[1][:, :3, 3]
        return align_truth(positions, evaluation["truth_from_estimate"])

    def _frame(
        self, row: dict[str, str], observations: NDArray[Any], latency_ms: float
    ) -> ResultFrame:
        index, timestamp_ns = int(row["index"]), _nanoseconds(row["timestamp"])
        segment = int(row["segment"])
        covariance = self._covariances.get(index)
        return ResultFrame(
            index=index,
            timestamp_ns=timestamp_ns,
            state=row["state"],
            reason=row["reason"],
            segment=None if segment < 0 else segment,
            is_keyframe=row["keyframe"] == "1",
            world_from_camera=self._poses[timestamp_ns] if row["posed"] == "1" else None,
            relative_pose=None if covariance is None else RelativePose(covariance),
            num_matches=int(row["matches"]),
            num_inliers=int(row["inliers"]),
            parallax_deg=float(row["parallax"]),
            keypoints=np.stack([observations["x"], observations["y"]], axis=-1).astype(float),
            landmarks=observations["landmark"].astype(np.int64),
            image_file=self._image_file(row["image"]),
            latency_ms=latency_ms,
        )

    def _image_file(self, name: str) -> Path | None:
        folder = self.summary["image_folder"]
        file = None if folder is None else Path(folder) / name
        return file if file is not None and file.is_file() else None

    def _read_table(self, name: str) -> list[dict[str, str]]:
        with open(self._folder / name, newline="") as file:
            return list(csv.DictReader(file))


def record_result(result: Result, recorder: Recorder) -> None:
    """Logs a finished run, with its images where they are still in their files."""
    landmarks = result.new_landmarks()
    size = (result.intrinsics.width, result.intrinsics.height)
    for frame in result.frames():
        image = None if frame.image_file is None else _read_image(frame.image_file, size)
        recorder.frame(frame, image, latency_ms=frame.latency_ms)
        if frame.index in landmarks:
            recorder.landmarks(*landmarks[frame.index])
    for name, estimate in result.summary.get("calibration", {}).items():
        if isinstance(estimate, dict):
            recorder.camera(name, estimate["value"], estimate["sigma"])
    truth = result.truth()
    if truth is not None:
        recorder.truth(truth)
    recorder.finish()


def align_truth(
    positions: NDArray[np.float64], truth_from_estimate: dict[str, Any]
) -> NDArray[np.float64]:
    """Returns true positions, shape (n, 3), in the world of an estimate.

    Args:
        truth_from_estimate: The similarity in the results of corvo.evaluate().
    """
    x, y, z, w = truth_from_estimate["quaternion_xyzw"]
    offsets = positions - truth_from_estimate["translation"]
    turns = 2 * np.cross([-x, -y, -z], offsets)
    rotated: NDArray[np.float64] = offsets + w * turns + np.cross([-x, -y, -z], turns)
    return rotated / float(truth_from_estimate["scale"])


def _nanoseconds(seconds: str) -> int:
    """Returns a time in seconds with nine decimals, ns, without rounding."""
    return int(seconds.replace(".", ""))


def _covariance(row: dict[str, str]) -> NDArray[np.float64]:
    """Returns the symmetric matrix whose upper triangle a row has."""
    covariance = np.empty((6, 6))
    for i in range(6):
        for j in range(i, 6):
            covariance[i, j] = covariance[j, i] = float(row[f"c{i}{j}"])
    return covariance


def _read_map(file: Path) -> NDArray[Any]:
    data = file.read_bytes()
    end = b"end_header\n"
    return np.frombuffer(data, _PLY_POINT, offset=data.index(end) + len(end))


def _read_image(file: Path, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Reads an image as 8-bit gray or RGB, of the size (width, height) that the run used. The gray
    levels of 16-bit images are spread to the range of 8 bits."""
    with Image.open(file) as stored:
        image: Image.Image = stored
        if image.mode.startswith(("I", "F")):
            levels = np.asarray(image, float)
            image = Image.fromarray((255 / max(levels.max(), 1) * levels).astype(np.uint8))
        used = image.convert("L" if image.mode in ("1", "L", "LA") else "RGB")
        return np.asarray(used if used.size == size else used.resize(size))
