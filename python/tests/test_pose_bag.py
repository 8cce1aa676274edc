# SPDX-License-Identifier: MIT
"""The poses of a result, written into ROS bags, are read again by rosbags."""

from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

from corvo import pose_bag


@pytest.mark.parametrize("name", ["poses.bag", "poses.mcap", "poses"])
def test_the_poses_are_those_of_the_trajectory(
    command_result: Path, tmp_path: Path, name: str
) -> None:
    path = tmp_path / name
    assert pose_bag.main([str(command_result), "-o", str(path), "--topic", "/pose"]) == 0
    assert list(tmp_path.iterdir()) == [path]
    with AnyReader([path]) as reader:
        assert {connection.topic for connection in reader.connections} == {"/pose"}
        messages = [
            (reader.deserialize(data, connection.msgtype), time_ns)
            for connection, time_ns, data in reader.messages()
        ]
    lines = (command_result / "trajectory.tum").read_text().splitlines()
    expected = [line.split() for line in lines if not line.startswith("#")]
    assert len(messages) == len(expected) > 0
    for (message, time_ns), (time, *numbers) in zip(messages, expected):
        stamp, point, turn = message.header.stamp, message.pose.position, message.pose.orientation
        assert message.header.frame_id == "corvo_segment_0"
        assert f"{stamp.sec}.{stamp.nanosec:09}" == time
        assert time_ns == stamp.sec * 10**9 + stamp.nanosec
        read = [point.x, point.y, point.z, turn.x, turn.y, turn.z, turn.w]
        assert read == [float(number) for number in numbers]


def test_a_file_is_never_replaced(
    command_result: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "poses.mcap"
    path.write_bytes(b"mine")
    assert pose_bag.main([str(command_result), "-o", str(path)]) == 1
    assert f"corvo: error: {path}: exists already" in capsys.readouterr().err
    assert path.read_bytes() == b"mine"


def test_a_folder_without_a_result_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert pose_bag.main([str(tmp_path), "-o", str(tmp_path / "poses.bag")]) == 1
    assert "is not the result of a run" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
