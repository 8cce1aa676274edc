# SPDX-License-Identifier: MIT
"""The poses in a result folder, with their segments."""

from __future__ import annotations

import csv
from collections import Counter
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

from corvo._corvo import Error


class ResultPose(NamedTuple):
    """The pose of a frame, world_from_camera."""

    time_ns: int
    segment: int
    position: tuple[float, float, float]
    """In the unit of the segment."""
    orientation: tuple[float, float, float, float]
    """Quaternion qx, qy, qz, qw."""


def read_poses(result: str | Path) -> list[ResultPose]:
    """Reads the posed frames of a result folder, in the order of the images.

    Raises:
        Error: The folder is not the complete result of a run.
    """
    frames, trajectory = Path(result) / "frames.csv", Path(result) / "trajectory.tum"
    try:
        with frames.open(newline="") as file:
            segments = [int(row["segment"]) for row in csv.DictReader(file) if row["posed"] == "1"]
        lines = [line for line in trajectory.read_text().splitlines() if not line.startswith("#")]
    except (OSError, KeyError, ValueError) as error:
        raise Error(f"{result}: is not the result of a run ({error})") from None
    if len(lines) != len(segments):
        raise Error(f"{trajectory}: {len(lines)} poses; {frames} has {len(segments)}")
    return [_pose(line, segment) for line, segment in zip(lines, segments)]


def largest_segment(poses: list[ResultPose]) -> list[ResultPose]:
    """Returns the poses of the segment that has most of them, of equal ones the first."""
    sizes = Counter(pose.segment for pose in poses)
    largest = max(sizes, key=lambda segment: sizes[segment], default=None)
    return [pose for pose in poses if pose.segment == largest]


def _pose(line: str, segment: int) -> ResultPose:
    time, *numbers = line.split()
    tx, ty, tz, qx, qy, qz, qw = map(float, numbers)
    return ResultPose(int(Decimal(time).scaleb(9)), segment, (tx, ty, tz), (qx, qy, qz, qw))
