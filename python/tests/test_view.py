# SPDX-License-Identifier: MIT
"""The live view: what recordings hold, and what a viewer costs."""

import csv
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from unittest.mock import create_autospec

import numpy as np
import pytest
from conftest import Sequence
from numpy.typing import NDArray
from PIL import Image

import corvo

rr = pytest.importorskip("rerun")
from rerun.chunk import RrdReader  # noqa: E402

from corvo import view  # noqa: E402
from corvo.similarity import Similarity  # noqa: E402
from corvo.view.ellipsoid import make_ellipsoid  # noqa: E402
from corvo.view.images import MAX_PIXELS, reduction  # noqa: E402
from corvo.view.path import PathPieces  # noqa: E402
from corvo.view.result import ResultFrame  # noqa: E402
from corvo.view.viewer import silent_environment  # noqa: E402

VGA = view.Intrinsics(640, 480, 525, 525, 319.5, 239.5)
EMPTY = ResultFrame(
    0, 0, "lost", "too_few_matches", None, False, None, None, 0, 0, 0.0,
    np.empty((0, 2)), np.empty(0, np.int64), "", None,
)  # fmt: skip


class Recording:
    """The rows of a recording, as a viewer reads them."""

    def __init__(self, file: Path) -> None:
        self._batches: dict[str, list[Any]] = {}
        for chunk in RrdReader(file).stream():
            if not chunk.is_static:
                self._batches.setdefault(chunk.entity_path, []).append(chunk.to_record_batch())

    def column(self, entity: str, name: str) -> list[Any]:
        """The values of a column in all rows of an entity that have it."""
        batches = [batch for batch in self._batches.get(entity, []) if name in batch.schema.names]
        values = [value for batch in batches for value in batch.column(name).to_pylist()]
        return [value for value in values if value is not None]

    def frames(self, entity: str) -> list[int]:
        """The frames at which an entity is logged."""
        return sorted(self.column(entity, "frame"))

    def num_path_points(self) -> int:
        strips = [
            *self.column("/world/path", "LineStrips3D:strips"),
            *self.column("/world/current", "LineStrips3D:strips"),
        ]
        return sum(len(strip) for row in strips for strip in row)


@dataclass(frozen=True)
class Saved:
    file: Path
    rows: list[dict[str, str]]  # Of the frames.csv with which it agrees.

    @property
    def recording(self) -> Recording:
        return Recording(self.file)

    def frames(self, column: str) -> list[int]:
        """The frames whose value in a column of frames.csv is 1."""
        return [int(row["index"]) for row in self.rows if row[column] == "1"]


def save(given: Path, file: Path, *options: object) -> subprocess.CompletedProcess[str]:
    arguments = ["view", given, *options, "--save", file]
    return subprocess.run(
        [sys.executable, "-m", "corvo", *map(str, arguments)], capture_output=True, text=True
    )


def read_rows(folder: Path) -> list[dict[str, str]]:
    with open(folder / "frames.csv", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def replayed(command_result: Path, tmp_path_factory: pytest.TempPathFactory) -> Saved:
    file = tmp_path_factory.mktemp("view") / "result.rrd"
    process = save(command_result, file)
    assert (process.returncode, process.stderr) == (0, "")
    return Saved(file, read_rows(command_result))


def posed_frames(count: int, keyframe_every: int) -> list[ResultFrame]:
    """Frames of a camera that moves along x."""
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, 0, 3] = np.arange(count)
    return [
        replace(
            EMPTY,
            index=i,
            timestamp_ns=i,
            segment=0,
            world_from_camera=pose,
            is_keyframe=i % keyframe_every == 0,
        )
        for i, pose in enumerate(poses)
    ]


def record(file: Path, frames: list[ResultFrame]) -> Recording:
    stream = view.make_stream()
    view.save_to(stream, file)
    recorder = view.Recorder(stream, VGA)
    for frame in frames:
        recorder.frame(frame)
    recorder.finish()
    stream.disconnect()
    return Recording(file)


def test_a_recording_of_a_result_has_every_frame_of_it(replayed: Saved) -> None:
    recording = replayed.recording
    every_frame = list(range(len(replayed.rows)))
    for entity in ("/series/matches", "/series/latency", "/world/camera/image"):
        assert recording.frames(entity) == every_frame
    assert recording.frames("/world/camera") == replayed.frames("posed")
    assert recording.frames("/world/uncertainty") == replayed.frames("keyframe")


def test_the_path_in_a_recording_passes_every_position(
    replayed: Saved, command_result: Path
) -> None:
    strips = replayed.recording.column("/world/path", "LineStrips3D:strips")
    recorded = np.concatenate([strip for row in strips for strip in row])
    positions = corvo.read_tum(command_result / "trajectory.tum")[1][:, :3, 3]
    distances = np.linalg.norm(recorded[:, None] - positions[None], axis=-1)
    assert distances.min(axis=0).max() < 1e-6


def write_png(folder: Path, images: list[NDArray[Any]]) -> Path:
    folder.mkdir()
    for i, image in enumerate(images):
        Image.fromarray(image).save(folder / f"{i:04}.png")
    return folder


def shown(result: corvo.Result) -> list[tuple[Any, Any]]:
    """The image and the mask of each frame, as they are given to a recorder."""
    recorder = create_autospec(view.Recorder, instance=True)
    view.record_result(result, recorder)
    return [call.args[1:3] for call in recorder.frame.call_args_list]


def test_16_bit_images_of_a_result_are_those_of_the_run(room: Sequence, tmp_path: Path) -> None:
    # The brightness varies: an image alone does not tell how the run converted it.
    stored = [
        7000 + (5 + i % 3) * image.astype(np.uint16) for i, image in enumerate(room.images[:6])
    ]
    files = write_png(tmp_path / "images", stored)
    result = corvo.run(files, camera=room.camera)
    low, high = (result.summary["gray_levels"][name] for name in ("low", "high"))
    expected = [np.clip(255 * (image - float(low)) / (high - low), 0, 255) for image in stored]
    for (image, _), levels in zip(shown(result), expected, strict=True):
        assert np.abs(image - levels).max() <= 1


def test_a_result_is_shown_with_its_masks_and_size(room: Sequence, tmp_path: Path) -> None:
    mask = np.full((480, 640), 255, np.uint8)
    mask[:, :100] = 0
    Image.fromarray(mask).save(tmp_path / "mask.png")
    files = write_png(tmp_path / "images", room.images[:12])
    options: dict[str, Any] = {"start": 2, "every": 3, "resize": 0.5, "mask": tmp_path / "mask.png"}
    result = corvo.run(files, camera=room.camera, **options)
    expected = [
        (np.asarray(Image.fromarray(image).reduce(2)), mask[::2, ::2])
        for image in room.images[2:12:3]
    ]
    for (image, used), (reduced, halved) in zip(shown(result), expected, strict=True):
        assert np.abs(image.astype(int) - reduced).max() <= 1
        np.testing.assert_array_equal(used, halved)


def test_the_images_of_a_bag_are_shown(room: Sequence, tmp_path: Path) -> None:
    pytest.importorskip("rosbags")
    from bag_file import BagFile

    with BagFile(tmp_path / "film.mcap") as bag:
        for time_ns, image in zip(room.timestamps_ns[:6], room.images):
            bag.write_image("/image", time_ns, "mono8", image)
    result = corvo.run(tmp_path / "film.mcap", camera=room.camera)
    for (image, mask), original in zip(shown(result), room.images[:6], strict=True):
        np.testing.assert_array_equal(image, original)
        assert mask is None


def test_the_images_of_a_film_are_shown(room: Sequence, tmp_path: Path) -> None:
    cv2 = pytest.importorskip("cv2")
    film = str(tmp_path / "film.avi")
    writer = cv2.VideoWriter(film, cv2.VideoWriter_fourcc(*"MJPG"), 30, (640, 480))
    for image in room.images[:6]:
        writer.write(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR))
    writer.release()
    for (image, _), original in zip(
        shown(corvo.run(film, camera=room.camera)), room.images[:6], strict=True
    ):
        assert np.abs(image.astype(int) - original).mean() < 5  # The loss of Motion JPEG.


def test_images_that_have_changed_are_not_shown(room: Sequence, tmp_path: Path) -> None:
    files = write_png(tmp_path / "images", room.images[:6])
    result = corvo.run(files, camera=room.camera)
    (files / "0003.png").unlink()
    assert [image is not None for image, _ in shown(result)] == [True] * 3 + [False] * 3
    shutil.rmtree(files)
    process = save(result.folder, tmp_path / "result.rrd")
    assert process.returncode == 0
    assert process.stderr.startswith(f"corvo: the images are not shown: {files}: no such folder")
    recording = Recording(tmp_path / "result.rrd")
    assert recording.frames("/series/matches") == list(range(6))
    assert recording.frames("/world/camera/image") == []


def test_a_landmark_is_recorded_once(replayed: Saved, command_result: Path) -> None:
    points = replayed.recording.column("/world/landmarks", "Points3D:positions")
    header = (command_result / "map.ply").read_bytes().split(b"end_header")[0]
    assert f"element vertex {sum(map(len, points))}\n".encode() in header
    assert set(replayed.recording.frames("/world/landmarks")) <= set(replayed.frames("keyframe"))


def test_tracks_are_the_observations(replayed: Saved, command_result: Path) -> None:
    recorded = replayed.recording.column("/world/camera/image/tracks", "Points2D:positions")
    assert sum(map(len, recorded)) == len(np.load(command_result / "observations.npy"))


def test_a_recording_opens_with_its_own_views(replayed: Saved) -> None:
    assert len(RrdReader(replayed.file).blueprints()) == 1


def test_2000_frames_are_at_most_200_mb(replayed: Saved) -> None:
    assert replayed.file.stat().st_size / len(replayed.rows) <= 200e6 / 2000


@pytest.mark.parametrize("size", [(640, 480), (1241, 376), (1920, 1080), (4000, 3000)])
def test_images_are_reduced_to_a_bounded_size(size: tuple[int, int]) -> None:
    width, height = size
    factor = reduction(width, height)
    assert np.ceil(width / factor) * np.ceil(height / factor) <= 1.01 * MAX_PIXELS


def test_a_running_odometry_is_recorded(room: Sequence, tmp_path: Path) -> None:
    file = tmp_path / "live.rrd"
    process = save(room.folder, file, "--camera", room.folder / "camera.yaml")
    assert process.returncode == 0
    recording = Recording(file)
    assert recording.frames("/series/matches") == list(range(len(room.images)))
    frames = room.process(corvo.Odometry(room.camera))
    posed = [frame.index for frame in frames if frame.world_from_camera is not None]
    assert recording.frames("/world/camera") == posed
    num_images = len(recording.frames("/world/camera/image"))
    num_dropped = len(room.images) - num_images
    message = f"{num_dropped} of {len(room.images)} images were not shown"
    assert (message in process.stderr) == (num_dropped > 0)
    assert len(recording.frames("/camera/fx")) > 0


@pytest.mark.parametrize("keyframe_every", [5, 10**6])
def test_the_path_is_not_logged_anew(tmp_path: Path, keyframe_every: int) -> None:
    counts = [
        record(tmp_path / f"{n}.rrd", posed_frames(n, keyframe_every)).num_path_points()
        for n in (300, 600)
    ]
    assert counts[1] <= 2.1 * counts[0]
    assert counts[1] <= (PathPieces.MAX_POSITIONS / 2 + 3) * 600


def test_the_path_is_interrupted_where_no_frame_has_a_pose(tmp_path: Path) -> None:
    frames = posed_frames(10, keyframe_every=100)
    frames[4] = replace(EMPTY, index=4, timestamp_ns=4, segment=0)
    recording = record(tmp_path / "gap.rrd", frames)
    strips = recording.column("/world/path", "LineStrips3D:strips")
    assert [[point[0] for point in row[0]] for row in strips] == [[0, 1, 2, 3], [5, 6, 7, 8, 9]]


class SlowRecorder:
    """Waits before it logs the first frame."""

    def __init__(self) -> None:
        self.may_start = threading.Event()
        self.images: list[bool] = []

    def frame(self, frame: Any, image: Any, mask: Any, latency_ms: Any) -> None:
        self.may_start.wait()
        self.images.append(image is not None)


def test_a_slow_viewer_drops_images_but_no_results() -> None:
    recorder = SlowRecorder()
    image = np.zeros((4, 4), np.uint8)
    with view.Sink(recorder) as sink:  # type: ignore[arg-type]
        for _ in range(20):
            sink.frame(EMPTY, image)
        recorder.may_start.set()
    assert sink.num_dropped == 20 - view.Sink.MAX_IMAGES
    assert recorder.images == [True] * view.Sink.MAX_IMAGES + [False] * sink.num_dropped


def test_an_error_of_the_thread_is_raised_at_the_end(tmp_path: Path) -> None:
    stream = view.make_stream()
    view.save_to(stream, tmp_path / "error.rrd")
    with pytest.raises(AttributeError, match="index"):
        with view.Sink(view.Recorder(stream, VGA)) as sink:
            sink.frame(None)  # type: ignore[arg-type]


def test_an_ellipsoid_holds_the_position_with_95_percent() -> None:
    generator = np.random.default_rng(1)
    factor = generator.normal(size=(6, 6))
    covariance = factor @ factor.T
    pose = np.eye(4)
    pose[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    pose[:3, 3] = [1, 2, 3]
    ellipsoid = make_ellipsoid(pose, covariance)
    errors = generator.multivariate_normal(np.zeros(3), covariance[:3, :3], size=20000)
    positions = errors @ pose[:3, :3].T
    axes = quaternion_matrix(ellipsoid.quaternions.as_arrow_array().to_pylist()[0])
    half_sizes = np.array(ellipsoid.half_sizes.as_arrow_array().to_pylist()[0])
    inside = np.linalg.norm(positions @ axes / half_sizes, axis=1) < 1
    assert inside.mean() == pytest.approx(0.95, abs=0.006)  # 4 standard deviations.


def quaternion_matrix(quaternion: list[float]) -> NDArray[np.float64]:
    x, y, z, w = quaternion
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


def test_truth_is_aligned_by_the_inverse_of_the_evaluation() -> None:
    similarity = {
        "scale": 2.0,
        "quaternion_xyzw": [0, 0, np.sin(0.3), np.cos(0.3)],
        "translation": [1, 2, 3],
    }
    turn = np.array(
        [[np.cos(0.6), -np.sin(0.6), 0], [np.sin(0.6), np.cos(0.6), 0], [0, 0, 1]]
    )
    estimate = np.array([[0.0, 0, 0], [1, -2, 3], [4, 5, -6]])
    truth = 2.0 * estimate @ turn.T + [1, 2, 3]
    assert Similarity(similarity).apply_inverse(truth) == pytest.approx(estimate)


def test_wrong_usage_is_an_error_of_the_command() -> None:
    process = subprocess.run(
        [sys.executable, "-m", "corvo", "view"], capture_output=True, text=True
    )
    assert process.returncode == 1
    assert process.stderr.startswith("corvo: error: ") and "RESULT|INPUT" in process.stderr


def test_a_folder_that_is_no_input_is_an_error_that_names_it(tmp_path: Path) -> None:
    process = save(tmp_path / "missing", tmp_path / "no.rrd")
    assert process.returncode == 1
    assert process.stderr.startswith("corvo: error: ") and "missing" in process.stderr
    assert not (tmp_path / "no.rrd").exists()


def test_messages_are_those_of_the_command(room: Sequence, tmp_path: Path) -> None:
    files = write_png(tmp_path / "images", room.images[:3])
    process = save(tmp_path, tmp_path / "live.rrd", "--camera", room.folder / "camera.yaml")
    assert process.returncode == 0
    assert process.stderr.startswith(f"corvo: info: {tmp_path}: has its images in {files}\n")


def test_a_result_takes_no_options_of_a_run(command_result: Path, tmp_path: Path) -> None:
    process = save(command_result, tmp_path / "no.rrd", "--every", "2")
    assert process.returncode == 1
    assert process.stderr == "corvo: error: --every: a result takes no option but --save\n"


def test_without_a_display_the_error_names_the_option(command_result: Path) -> None:
    environment = {name: value for name, value in os.environ.items() if "DISPLAY" not in name}
    process = subprocess.run(
        [sys.executable, "-m", "corvo", "view", command_result],
        capture_output=True,
        text=True,
        env=environment,
    )
    assert process.returncode == 1
    assert process.stderr.endswith("write a recording with --save FILE\n")


def test_without_rerun_the_error_names_the_extra() -> None:
    program = "import sys; sys.modules['rerun'] = None; sys.argv[1:] = ['view', 'x']\n"
    program += "from corvo.__main__ import main; sys.exit(main())"
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert process.returncode == 1
    assert process.stderr == "corvo: error: rerun is not installed: pip install corvo[view]\n"


def start_viewer(environment: dict[str, str], home: Path) -> list[str]:
    """Starts Rerun with a home of its own. Returns the files that it has left there."""
    environment = {**environment, "HOME": str(home)}
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME"):
        environment.pop(name, None)
    command = [sys.executable, "-m", "rerun", "--serve-grpc", "--bind", "127.0.0.1"]
    with subprocess.Popen(
        [*command, "--port", "0"],
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as viewer:
        assert viewer.stderr is not None
        assert any("Listening for gRPC" in line for line in viewer.stderr)
        time.sleep(0.5)
        os.killpg(viewer.pid, signal.SIGTERM)  # With the process that the module starts.
    return sorted(path.name for path in home.rglob("analytics*"))


def test_the_viewer_collects_no_usage_data(tmp_path: Path) -> None:
    without = {name: value for name, value in os.environ.items() if name != "CI"}
    loud, silent = tmp_path / "loud", tmp_path / "silent"
    loud.mkdir(), silent.mkdir()
    assert "analytics.json" in start_viewer(without, loud)
    assert start_viewer(silent_environment(), silent) == []
