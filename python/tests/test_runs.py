# SPDX-License-Identifier: MIT
import json
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import Sequence, command

import corvo


def test_a_run_has_the_bytes_of_the_command(
    room: Sequence, command_result: Path, tmp_path: Path
) -> None:
    result = corvo.run(room.folder, camera=room.camera, output=tmp_path / "result")
    assert result.folder == tmp_path / "result"
    for name in ["trajectory.tum", "frames.csv", "map.ply", "pose_graph.g2o", "observations.npy"]:
        assert (result.folder / name).read_bytes() == (command_result / name).read_bytes(), name
    poses = result.world_from_camera
    assert poses.shape == (len(result.timestamps_ns), 4, 4)
    assert result.summary["complete"] is True
    assert result.camera.sigma


def test_real_images_give_the_bytes_of_the_command(data: Path, tmp_path: Path) -> None:
    sequence = data / "kitti" / "sequences" / "03"
    options = ["--count", 60, "--gt", "none", "-o", tmp_path / "expected", "--quiet"]
    subprocess.run(command("run", sequence, *options), check=True)
    result = corvo.run(sequence, count=60, gt="none")
    expected = (tmp_path / "expected" / "trajectory.tum").read_bytes()
    assert (result.folder / "trajectory.tum").read_bytes() == expected
    assert len(result.timestamps_ns) > 50


def test_a_temporary_result_is_removed_with_its_object(room: Sequence) -> None:
    result = corvo.run(room.folder, camera=room.camera, count=20)
    folder = result.folder
    assert (folder / "frames.csv").exists()
    del result
    assert not folder.exists()


def test_results_become_tables(room: Sequence) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    result = corvo.run(room.folder, camera=room.camera, count=20)
    frame = result.to_frame()
    assert list(frame["index"]) == list(range(20))
    assert set(frame["state"]) <= {"initializing", "tracking", "rotation_only", "lost"}
    assert result.to_arrow().to_pandas()["image"].tolist() == frame["image"].tolist()


def test_the_arrays_of_a_result_have_equal_indices(command_result: Path) -> None:
    result = corvo.Result(command_result)
    posed = [row for row in result.rows if row["posed"] == "1"]
    assert result.segments.tolist() == [int(row["segment"]) for row in posed]
    times = [int(row["timestamp"].replace(".", "")) for row in posed]
    assert result.timestamps_ns.tolist() == times
    x, y, z, w = result.orientations.T
    # The axis of the rotation times twice the sine and the cosine.
    rotations = result.world_from_camera[:, :3, :3]
    skew = rotations - rotations.transpose(0, 2, 1)
    expected = 4 * w * np.stack([x, y, z])
    np.testing.assert_allclose([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], expected, atol=1e-8)


def test_a_folder_that_is_no_result_is_an_error(command_result: Path, tmp_path: Path) -> None:
    message = f"{tmp_path}: is not the result of a run; it has no "
    with pytest.raises(corvo.Error, match=message + "summary.json"):
        corvo.Result(tmp_path).summary
    (tmp_path / "trajectory.tum").write_bytes((command_result / "trajectory.tum").read_bytes())
    with pytest.raises(corvo.Error, match=message + "frames.csv"):
        corvo.Result(tmp_path).segments
    (tmp_path / "frames.csv").write_text("posed,segment\n1,0\n")
    with pytest.raises(corvo.Error, match="frames.csv: 1 frames are posed; .* have a pose"):
        corvo.Result(tmp_path).segments
    (tmp_path / "frames.csv").write_text("posed\n1\n")
    with pytest.raises(corvo.Error, match="frames.csv: is no table of frames"):
        corvo.Result(tmp_path).segments


def test_errors_are_those_of_the_command(room: Sequence, tmp_path: Path) -> None:
    with pytest.raises(corvo.Error, match="none: "):
        corvo.run(tmp_path / "none")
    with pytest.raises(corvo.Error, match="--no-such-option"):
        corvo.run(room.folder, no_such_option=1)
    with pytest.raises(corvo.Error, match="ships no calibration; give --camera FILE"):
        corvo.run(room.folder / "rgb", fps=30)


def test_options_of_a_run(room: Sequence) -> None:
    options = corvo.Options({"extractor": {"num_features": 400}})
    result = corvo.run(room.folder, camera=room.folder / "camera.yaml", config=options, count=10)
    assert "num_features: 400" in (result.folder / "config.yaml").read_text()


def test_a_result_is_evaluated_and_exported(room: Sequence, tmp_path: Path) -> None:
    result = corvo.run(room.folder, camera=room.camera)
    measures = corvo.evaluate(result)
    printed = subprocess.run(
        command("eval", result.folder, "--json"), check=True, capture_output=True
    ).stdout
    assert measures.items() <= json.loads(printed).items()
    odometry = corvo.Odometry(room.camera)
    room.process(odometry)
    truth = room.folder / "groundtruth.txt"
    assert corvo.evaluate(odometry.finish(), truth) == measures
    with pytest.raises(corvo.Error, match="alignment"):
        corvo.evaluate(result, align="other")

    model = corvo.export(result, to="colmap", output=tmp_path / "model", text=True)
    assert (model / "sparse" / "0" / "images.txt").exists()
    with pytest.raises(corvo.Error, match="--to"):
        corvo.export(result, to="other", output=tmp_path / "other")


def test_a_camera_is_calibrated(room: Sequence) -> None:
    camera = corvo.calibrate(room.folder, model="pinhole")
    assert camera.parameters["fx"] == pytest.approx(525, rel=0.05)
    assert camera.sigma


def test_nothing_is_printed(room: Sequence, tmp_path: Path) -> None:
    code = f"""
import corvo
folder = {str(room.folder)!r}
result = corvo.run(folder, camera=folder + "/camera.yaml", count=30)
corvo.export(result, to="colmap", output={str(tmp_path / 'model')!r})
"""
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    assert (done.stdout, done.stderr) == (b"", b"")


def test_ctrl_c_ends_a_run_with_its_result(room: Sequence, tmp_path: Path) -> None:
    code = f"""
import corvo
try:
    corvo.run({str(room.folder)!r}, camera={str(room.folder / 'camera.yaml')!r},
              output={str(tmp_path / 'result')!r})
except KeyboardInterrupt:
    print("interrupted")
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as process:
        interrupt_when_running(process, tmp_path)
        assert process.communicate()[0] == b"interrupted\n"
    assert process.returncode == 0
    summary = json.loads((tmp_path / "result" / "summary.json").read_text())
    assert summary["complete"] is False


def test_ctrl_c_ends_the_command(room: Sequence, tmp_path: Path) -> None:
    arguments = ["run", room.folder, "--camera", room.folder / "camera.yaml"]
    program = [sys.executable, "-m", "corvo", *map(str, arguments), "-o", str(tmp_path / "result")]
    with subprocess.Popen(program, stderr=subprocess.PIPE) as process:
        interrupt_when_running(process, tmp_path)
        message = process.communicate()[1]
    assert process.returncode == 130
    assert b"the partial result is in" in message


def interrupt_when_running(process: subprocess.Popen[bytes], folder: Path) -> None:
    """Interrupts a run once it has begun, which its staging folder shows."""
    deadline = time.monotonic() + 60
    while not any(folder.iterdir()) and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)


def test_runs_of_several_threads(room: Sequence, command_result: Path) -> None:
    results: list[corvo.Result] = []

    def run() -> None:
        results.append(corvo.run(room.folder, camera=room.camera))

    threads = [threading.Thread(target=run) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    expected = (command_result / "trajectory.tum").read_bytes()
    assert [(r.folder / "trajectory.tum").read_bytes() for r in results] == [expected] * 2


def test_the_version_is_that_of_the_package() -> None:
    printed = subprocess.run(
        [sys.executable, "-m", "corvo", "--version"], check=True, capture_output=True, text=True
    ).stdout.strip()
    source = Path(__file__).parents[2] / "CMakeLists.txt"
    assert f"project(corvo VERSION {printed} " in source.read_text()


def test_an_invalid_command_fails() -> None:
    process = subprocess.run([sys.executable, "-m", "corvo", "rum"], capture_output=True, text=True)
    assert process.returncode == 1
    assert process.stderr.startswith("corvo: error: ")
