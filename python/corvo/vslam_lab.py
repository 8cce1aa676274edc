# SPDX-License-Identifier: MIT
"""corvo as a baseline of VSLAM-LAB: python -m corvo.vslam_lab, or corvo-vslam-lab.

The images are those of --rgb_csv, a table with the columns "ts_NAME (ns)" and "path_NAME", relative
to --sequence_path. NAME is that of a camera in --calibration_yaml. The poses of the largest segment
are written to EXP_FOLDER/NNNNN_KeyFrameTrajectory.csv, NNNNN being --exp_id with five digits: for
each posed frame its time and the pose of the camera, x_in_world = R(q) x_in_camera + t.
"""

from __future__ import annotations

import argparse
import csv
import re
import sys
import tempfile
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from corvo import Error, run
from corvo.commands import report
from corvo.result import Result

_HEADER = ("ts (ns)", "tx (m)", "ty (m)", "tz (m)", "qx", "qy", "qz", "qw")


def track_sequence(sequence: Path, rgb_csv: Path, calibration: Path, settings: str) -> Result:
    """Runs the odometry on a sequence.

    Args:
        sequence: The folder to which the paths of the images are relative.
        rgb_csv: The table of the images.
        calibration: A file that `Camera.load` reads.
        settings: A configuration file of corvo, or an empty text for the default options.

    Raises:
        Error: A file is missing or malformed.
    """
    camera, images = _read_table(rgb_csv)
    with tempfile.TemporaryDirectory(prefix="corvo_vslam_lab_") as folder:
        # A TUM RGB-D sequence: a list of names in its folder, with times in seconds.
        listed = Path(folder) / "images"
        listed.mkdir()
        (listed / "sequence").symlink_to(sequence.absolute(), target_is_directory=True)
        lines = [f"{Decimal(time).scaleb(-9):f} sequence/{image}\n" for time, image in images]
        (listed / "rgb.txt").write_text("".join(lines))
        return run(listed, camera=f"{calibration}:{camera}", config=settings or None)


def in_largest_segment(segments: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Returns which poses are those of the segment that has most of them, of equal ones the first.

    Args:
        segments: The segment of each pose, shape (n,).
    """
    largest = int(np.bincount(segments, minlength=1).argmax())
    chosen: NDArray[np.bool_] = segments == largest
    return chosen


def write_trajectory(result: Result, file: Path) -> None:
    """Writes the poses of the largest segment as VSLAM-LAB reads them."""
    chosen = in_largest_segment(result.segments)
    poses = np.hstack([result.world_from_camera[:, :3, 3], result.orientations])
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w", newline="") as opened:
        writer = csv.writer(opened)
        writer.writerow(_HEADER)
        for time_ns, pose in zip(result.timestamps_ns[chosen].tolist(), poses[chosen].tolist()):
            writer.writerow((time_ns, *pose))


def _read_table(table: Path) -> tuple[str, list[tuple[int, str]]]:
    """Returns the name of the first camera in a table, and its images with their times in ns."""
    try:
        with table.open(newline="") as file:
            rows = csv.DictReader(file)
            paths = [name for name in rows.fieldnames or [] if name.startswith("path_")]
            if not paths:
                raise Error(f"{table}: has no column path_NAME")
            camera = paths[0].removeprefix("path_")
            return camera, [(int(row[f"ts_{camera} (ns)"]), row[paths[0]]) for row in rows]
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise Error(f"{table}: is no table of images ({error!r})") from None


def _parse(arguments: Sequence[str]) -> argparse.Namespace:
    """Reads "--name value" and "name:value". What corvo does not know is ignored."""
    parser = argparse.ArgumentParser(prog="corvo-vslam-lab", description=__doc__)
    parser.add_argument("--sequence_path", type=Path, required=True)
    parser.add_argument("--calibration_yaml", type=Path, required=True)
    parser.add_argument("--rgb_csv", type=Path, required=True)
    parser.add_argument("--exp_folder", type=Path, required=True)
    parser.add_argument("--exp_id", "--exp_it", type=int, required=True)
    parser.add_argument("--settings_yaml", default="", help="options of corvo; see 'corvo config'")
    parser.add_argument("--mode", default="mono", choices=["mono"])
    # "name:value" becomes "--name=value".
    full = [re.sub(r"^([a-z_]+):", r"--\1=", argument) for argument in arguments]
    return parser.parse_known_args(full)[0]


def main(arguments: Sequence[str] | None = None) -> int:
    """The command corvo-vslam-lab. Returns its exit code."""
    given = _parse(sys.argv[1:] if arguments is None else arguments)
    try:
        result = track_sequence(
            given.sequence_path, given.rgb_csv, given.calibration_yaml, given.settings_yaml
        )
    except Error as error:
        return report(error)
    write_trajectory(result, given.exp_folder / f"{given.exp_id:05}_KeyFrameTrajectory.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main())
