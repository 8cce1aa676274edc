# SPDX-License-Identifier: MIT
from pathlib import Path

import numpy as np
import pytest
from conftest import Sequence

import corvo


@pytest.fixture(scope="module")
def odometry(room: Sequence) -> corvo.Odometry:
    odometry = corvo.Odometry(room.camera, record=True)
    room.process(odometry)
    odometry.finish()
    return odometry


def test_the_trajectory_has_the_bytes_of_the_command(
    odometry: corvo.Odometry, command_result: Path, tmp_path: Path
) -> None:
    odometry.trajectory().write_tum(tmp_path / "trajectory.tum")
    expected = (command_result / "trajectory.tum").read_bytes()
    assert (tmp_path / "trajectory.tum").read_bytes() == expected
    assert expected.count(b"\n") > 50


def test_the_pose_graph_has_the_bytes_of_the_command(
    odometry: corvo.Odometry, command_result: Path
) -> None:
    graph = odometry.pose_graph()
    assert graph.to_g2o() == (command_result / "pose_graph.g2o").read_text()
    assert graph.edges[0].covariance.shape == (7, 7)


def test_every_frame_has_a_state_a_pose_and_a_covariance(room: Sequence) -> None:
    frame = room.process(corvo.Odometry(room.camera))[-1]
    assert (frame.state, frame.reason, frame.segment) == ("tracking", "none", 0)
    assert frame.index == len(room.images) - 1
    assert frame.timestamp_ns == room.timestamps_ns[-1]
    pose = frame.world_from_camera
    assert pose is not None
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
    np.testing.assert_array_equal(frame.rotation, pose[:3, :3])
    assert frame.relative_pose is not None
    assert np.linalg.eigvalsh(frame.relative_pose.covariance).min() > 0


def test_tracks_are_the_projections_of_landmarks(room: Sequence) -> None:
    odometry = corvo.Odometry(room.camera)
    frame = room.process(odometry)[-1]
    points = odometry.landmarks()
    positions = dict(zip(points.ids.tolist(), points.positions))
    camera_from_world = np.linalg.inv(frame.world_from_camera)
    in_world = np.array([positions[i] for i in frame.landmarks.tolist()])
    in_camera = in_world @ camera_from_world[:3, :3].T + camera_from_world[:3, 3]
    errors = np.linalg.norm(odometry.camera.project(in_camera) - frame.keypoints, axis=1)
    assert len(errors) > 100
    assert np.median(errors) < 1


def test_a_frame_without_a_pose_says_why(room: Sequence) -> None:
    odometry = corvo.Odometry(room.camera)
    frame = odometry.process(np.zeros_like(room.images[0]), 0)
    assert (frame.state, frame.reason) == ("initializing", "too_few_features")
    assert frame.world_from_camera is None
    assert frame.relative_pose is None
    assert frame.segment is None
    assert frame.keypoints.shape == (0, 2)
    assert odometry.process_missing(1).reason == "unreadable_image"


def test_a_refinement_moves_the_poses(odometry: corvo.Odometry, room: Sequence) -> None:
    refinement = corvo.refine(odometry)
    assert refinement.is_usable
    assert len(refinement.landmarks) > 100
    before = odometry.trajectory().world_from_camera
    assert refinement.trajectory.world_from_camera.shape == before.shape
    assert not np.array_equal(refinement.trajectory.world_from_camera, before)


def test_a_refinement_needs_a_record(room: Sequence) -> None:
    with pytest.raises(corvo.Error, match="make it with record=True"):
        corvo.refine(corvo.Odometry(room.camera))


def test_a_trajectory_becomes_a_table(odometry: corvo.Odometry, command_result: Path) -> None:
    pandas = pytest.importorskip("pandas")
    frame = odometry.trajectory().to_frame()
    expected = pandas.read_csv(command_result / "frames.csv")
    only_of_files = ["drift_sigma", "image"]
    pandas.testing.assert_frame_equal(
        frame.drop(columns=only_of_files), expected.drop(columns=only_of_files)
    )


def test_a_reset_odometry_starts_anew(room: Sequence) -> None:
    odometry = corvo.Odometry(room.camera)
    odometry.process(room.images[0], 5)
    odometry.reset()
    assert odometry.process(room.images[0], 5).index == 0


def test_times_must_increase(room: Sequence) -> None:
    odometry = corvo.Odometry(room.camera)
    odometry.process(room.images[0], 5)
    with pytest.raises(corvo.Error, match="time of frame 1 is 5 ns; it must be after"):
        odometry.process(room.images[1], 5)
    assert odometry.process(room.images[1], 6).index == 1


def test_options_are_checked(room: Sequence, tmp_path: Path) -> None:
    options = corvo.Options({"extractor": {"num_features": 300, "ranking": "harris"}})
    frame = corvo.Odometry(room.camera, options).process(room.images[0], 0)
    assert frame.num_features == 300
    with pytest.raises(corvo.Error, match="num_features is -1; allowed is 0 to 100000"):
        corvo.Options({"extractor": {"num_features": -1}})
    with pytest.raises(corvo.Error, match="nearest known key is extractor.num_features"):
        corvo.Options({"extractor": {"num_feature": 1}})
    (tmp_path / "options.yaml").write_text(str(options))
    assert str(corvo.Options.load(tmp_path / "options.yaml")) == str(options)
    with pytest.raises(corvo.Error, match="threads is 0; allowed is 1 to 256"):
        corvo.Odometry(room.camera, threads=0)
