# SPDX-License-Identifier: MIT
"""The poses of a result as a ROS bag, by the package rosbags of corvo[bags]."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from contextlib import AbstractContextManager
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from corvo._corvo import Error
from corvo.bags import missing_rosbags
from corvo.commands import report
from corvo.result import Result

_TYPE = "geometry_msgs/msg/PoseStamped"


def write_poses(
    result: Result | str | Path, bag: str | Path, topic: str = "/corvo/pose"
) -> None:
    """Writes the posed frames of a result into a bag, a geometry_msgs/PoseStamped for each.

    A pose is that of the camera (x right, y down, z forward) in the frame corvo_segment_N, N the
    segment of the frame; segments do not share a scale. The stamps are those of the images.

    Args:
        result: The result of a run, or its folder.
        bag: The file to write, .bag for ROS 1 or .mcap for ROS 2, or any other name for a folder
            of ROS 2 with SQLite. It must not exist.
        topic: The topic of the poses.

    Raises:
        Error: The result cannot be read, the bag exists or cannot be written.
    """
    target = Path(bag)
    poses = _poses_of(result if isinstance(result, Result) else Result(result))
    if find_spec("rosbags") is None:
        raise missing_rosbags(target)
    if target.exists():
        raise Error(f"{target}: exists already")
    try:
        with tempfile.TemporaryDirectory(prefix=".corvo_bag_", dir=target.parent) as folder:
            written = Path(folder) / target.name
            _write(poses, written, topic)
            (next(written.glob("*.mcap")) if target.suffix == ".mcap" else written).rename(target)
    except OSError as error:
        raise Error(f"{target}: cannot be written ({error})") from None


class _Pose(NamedTuple):
    time_ns: int
    segment: int
    position: list[float]
    orientation: list[float]
    """Quaternion x, y, z, w."""


def _poses_of(result: Result) -> list[_Pose]:
    return [
        _Pose(*pose)
        for pose in zip(
            result.timestamps_ns.tolist(),
            result.segments.tolist(),
            result.world_from_camera[:, :3, 3].tolist(),
            result.orientations.tolist(),
            strict=True,
        )
    ]


def _write(poses: list[_Pose], bag: Path, topic: str) -> None:
    from rosbags.typesys import Stores, get_typestore

    is_ros1 = bag.suffix == ".bag"
    types = get_typestore(Stores.ROS1_NOETIC if is_ros1 else Stores.LATEST)
    serialize = types.serialize_ros1 if is_ros1 else types.serialize_cdr
    with _create(bag) as writer:
        connection = writer.add_connection(topic, _TYPE, typestore=types)
        for index, pose in enumerate(poses):
            message = _message(types.types, index if is_ros1 else None, pose)
            writer.write(connection, pose.time_ns, serialize(message, _TYPE))


def _create(bag: Path) -> AbstractContextManager[Any]:
    from rosbags import rosbag1, rosbag2

    if bag.suffix == ".bag":
        return rosbag1.Writer(bag)
    is_mcap = bag.suffix == ".mcap"
    storage = rosbag2.StoragePlugin.MCAP if is_mcap else rosbag2.StoragePlugin.SQLITE3
    return rosbag2.Writer(bag, version=8, storage_plugin=storage)


def _message(types: Any, sequence: int | None, pose: _Pose) -> Any:
    """Returns a PoseStamped; only the header of ROS 1 has a sequence number."""
    seconds, nanoseconds = divmod(pose.time_ns, 1_000_000_000)
    header = {
        "stamp": types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds),
        "frame_id": f"corvo_segment_{pose.segment}",
    }
    if sequence is not None:
        header["seq"] = sequence
    return types[_TYPE](
        header=types["std_msgs/msg/Header"](**header),
        pose=types["geometry_msgs/msg/Pose"](
            position=types["geometry_msgs/msg/Point"](*pose.position),
            orientation=types["geometry_msgs/msg/Quaternion"](*pose.orientation),
        ),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """The command corvo-bag. Returns its exit code."""
    parser = argparse.ArgumentParser(
        prog="corvo-bag", description="Write the poses of a result of corvo run into a ROS bag."
    )
    parser.add_argument("result", metavar="RESULT", help="folder of the result")
    parser.add_argument(
        "-o", "--output", required=True, help=".bag or .mcap file, or a folder for ROS 2"
    )
    parser.add_argument("--topic", default="/corvo/pose", help="topic of the poses")
    given = parser.parse_args(arguments)
    try:
        write_poses(given.result, given.output, given.topic)
    except Error as error:
        return report(error)
    return 0


if __name__ == "__main__":
    sys.exit(main())
