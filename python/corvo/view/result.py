# SPDX-License-Identifier: MIT
"""Reads the folder of a finished run and logs it as if it were running."""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import corvo
from corvo._corvo import ResultImages
from corvo.similarity import Similarity
from corvo.view.recorder import Recorder

_PLY_POINT = np.dtype(
    [
        ("position", "<f8", 3),
        ("rgb", "u1", 3),
        ("id", "<i4"),
        ("segment", "<i4"),
        ("observations", "<i4"),
    ]
)


_NamedImage = tuple[str, NDArray[np.uint8] | None, NDArray[np.uint8] | None]
"""The name of an image as in frames.csv, the image and its mask."""

_NO_IMAGE: _NamedImage = ("", None, None)


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
    image_name: str
    latency_ms: float | None


class Replay:
    """What a finished run found, in the order in which a running odometry finds it.

    Raises:
        Error: A file of the result is missing.
    """

    def __init__(self, result: corvo.Result) -> None:
        self._result = result
        self._poses = dict(zip(result.timestamps_ns.tolist(), result.world_from_camera))
        self._covariances = {
            int(row["index"]): _covariance(row) for row in result.read_table("relative_poses.csv")
        }
        observations = np.load(result.file("observations.npy"))
        order = np.argsort(observations["frame"], kind="stable")
        self._observations = observations[order]

    def frames(self) -> Iterator[ResultFrame]:
        """Yields the frames in the order of their images."""
        latencies = [float(row["total_ms"]) for row in self._result.read_table("timing.csv")]
        numbers = self._observations["frame"]
        for row, latency_ms in zip(self._result.rows, latencies, strict=True):
            index = int(row["index"])
            first, last = np.searchsorted(numbers, [index, index + 1])
            yield self._frame(row, self._observations[first:last], latency_ms)

    def new_landmarks(self) -> dict[int, tuple[NDArray[np.float64], NDArray[np.uint8]]]:
        """Returns the positions and colors of the landmarks by the keyframe that shows them.

        A landmark is shown at the first keyframe from its first observation on; without one, at the
        last keyframe.
        """
        points = _read_map(self._result.file("map.ply"))
        rows = self._result.rows
        keyframes = np.array([int(row["index"]) for row in rows if row["keyframe"] == "1"])
        if len(keyframes) == 0:
            return {}
        ids, firsts = np.unique(self._observations["landmark"], return_index=True)
        first_frames = dict(zip(ids.tolist(), self._observations["frame"][firsts].tolist()))
        seen = np.array([first_frames.get(id, 0) for id in points["id"].tolist()])
        shown = np.minimum(np.searchsorted(keyframes, seen), len(keyframes) - 1)
        return {
            int(keyframe): (points["position"][shown == i], points["rgb"][shown == i])
            for i, keyframe in enumerate(keyframes)
        }

    def truth(self) -> NDArray[np.float64] | None:
        """Returns the true path in the world of the trajectory, shape (n, 3), if it is known."""
        file = self._result.folder / "groundtruth.tum"
        evaluation = self._result.summary.get("evaluation")
        if evaluation is None or not file.is_file():
            return None
        positions = corvo.read_tum(file)[1][:, :3, 3]
        return Similarity(evaluation["truth_from_estimate"]).apply_inverse(positions)

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
            image_name=row["image"],
            latency_ms=latency_ms,
        )


def record_result(result: corvo.Result, recorder: Recorder) -> None:
    """Logs a finished run, with its images where its input still has them."""
    replay = Replay(result)
    landmarks = replay.new_landmarks()
    images = _open_images(result.folder)
    for frame in replay.frames():
        name, image, mask = next(images, _NO_IMAGE)
        if name != frame.image_name:  # The input has changed since.
            image = mask = None
        recorder.frame(frame, image, mask, frame.latency_ms)
        if frame.index in landmarks:
            recorder.landmarks(*landmarks[frame.index])
    for name, estimate in result.summary.get("calibration", {}).items():
        if isinstance(estimate, dict):
            recorder.camera(name, estimate["value"], estimate["sigma"])
    truth = replay.truth()
    if truth is not None:
        recorder.truth(truth)
    recorder.finish()


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


def _open_images(folder: Path) -> Iterator[_NamedImage]:
    """Opens the images of a result; if they cannot be read, says why and returns none."""
    try:
        return iter(ResultImages(folder))
    except corvo.Error as error:
        print(f"corvo: the images are not shown: {error}", file=sys.stderr)
        return iter(())
