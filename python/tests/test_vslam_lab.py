# SPDX-License-Identifier: MIT
"""A rendered sequence in the convention of VSLAM-LAB gives the trajectory of the command."""

import csv
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from conftest import NUM_FRAMES, Sequence

from corvo import vslam_lab


@pytest.fixture(scope="module")
def laboratory(room: Sequence, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with images in rgb_0, rgb.csv and calibration.yaml."""
    folder = tmp_path_factory.mktemp("laboratory")
    (folder / "rgb_0").symlink_to(room.folder / "rgb")
    files = sorted(file.name for file in (folder / "rgb_0").glob("*.png"))
    with (folder / "rgb.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("ts_rgb_0 (ns)", "path_rgb_0"))
        writer.writerows(zip(room.timestamps_ns, (f"rgb_0/{name}" for name in files)))
    camera = room.camera.parameters
    (folder / "calibration.yaml").write_text(
        "%YAML:1.0\n"
        "cameras:\n"
        "- cam_name: rgb_0\n"
        "  cam_type: rgb\n"
        "  cam_model: pinhole\n"
        f"  focal_length: [{camera['fx']}, {camera['fy']}]\n"
        f"  principal_point: [{camera['cx']}, {camera['cy']}]\n"
        f"  image_dimension: [{room.camera.width}, {room.camera.height}]\n"
        "  fps: 30\n"
    )
    return folder


def arguments(laboratory: Path, results: Path, experiment: int) -> dict[str, object]:
    return {
        "sequence_path": laboratory,
        "calibration_yaml": laboratory / "calibration.yaml",
        "rgb_csv": laboratory / "rgb.csv",
        "exp_folder": results,
        "exp_id": experiment,
    }


def options(given: Mapping[str, object]) -> list[str]:
    return [text for name, value in given.items() for text in (f"--{name}", str(value))]


def read(file: Path) -> list[list[str]]:
    with file.open(newline="") as opened:
        return list(csv.reader(opened))


def test_the_trajectory_is_that_of_the_command(
    laboratory: Path, command_result: Path, tmp_path: Path
) -> None:
    given = options(arguments(laboratory, tmp_path / "new", 7))
    assert vslam_lab.main([*given, "--verbose", "0", "--mode", "mono", "--upsample", "0"]) == 0
    header, *rows = read(tmp_path / "new" / "00007_KeyFrameTrajectory.csv")
    assert header == ["ts (ns)", "tx (m)", "ty (m)", "tz (m)", "qx", "qy", "qz", "qw"]
    lines = (command_result / "trajectory.tum").read_text().splitlines()
    expected = [line.split() for line in lines if not line.startswith("#")]
    assert len(rows) == len(expected) > NUM_FRAMES // 2
    for (time, *pose), (seconds, *numbers) in zip(rows, expected):
        assert int(time) == int(seconds.replace(".", ""))
        assert [*map(float, pose)] == [*map(float, numbers)]


def test_arguments_may_be_written_with_colons(laboratory: Path, tmp_path: Path) -> None:
    settings = tmp_path / "settings.yaml"
    settings.write_text("extractor:\n  num_features: 700\n")
    given = arguments(laboratory, tmp_path, 0) | {"settings_yaml": settings}
    module = [sys.executable, "-m", "corvo.vslam_lab"]
    subprocess.run([*module, *(f"{name}:{value}" for name, value in given.items())], check=True)
    assert vslam_lab.main(options(arguments(laboratory, tmp_path, 1))) == 0
    fewer = read(tmp_path / "00000_KeyFrameTrajectory.csv")
    assert len(fewer) > NUM_FRAMES // 2
    assert fewer != read(tmp_path / "00001_KeyFrameTrajectory.csv"), "the settings are used"


def test_only_the_largest_segment_is_written() -> None:
    chosen = vslam_lab.in_largest_segment(np.array([0, 0, 1, 1, 1, 2, 2, 2]))
    assert chosen.tolist() == [False, False, True, True, True, False, False, False]
    assert len(vslam_lab.in_largest_segment(np.empty(0, np.int64))) == 0


@pytest.mark.parametrize(
    ("table", "error"),
    [
        (None, "rgb.csv: is no table of images"),
        ("ts,path\n1,a.png\n", "rgb.csv: has no column path_NAME"),
        ("ts_rgb_0 (ns),path_rgb_0\none,a.png\n", "rgb.csv: is no table of images"),
        ("ts_rgb_0 (ns),path_rgb_0\n1,none.png\n", "sequence/none.png"),
        ("ts_rgb_1 (ns),path_rgb_1\n1,a.png\n", "holds no camera rgb_1; it holds rgb_0"),
    ],
)
def test_malformed_tables_are_errors(
    laboratory: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    table: str | None,
    error: str,
) -> None:
    if table:
        (tmp_path / "rgb.csv").write_text(table)
    given = arguments(laboratory, tmp_path / "new", 0) | {"rgb_csv": tmp_path / "rgb.csv"}
    assert vslam_lab.main(options(given)) == 1
    assert error in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_other_modes_are_refused(laboratory: Path, tmp_path: Path) -> None:
    with pytest.raises(SystemExit):
        vslam_lab.main([*options(arguments(laboratory, tmp_path, 0)), "--mode", "rgbd"])
