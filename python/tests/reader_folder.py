# SPDX-License-Identifier: MIT
"""The folder of somebody who reads the documentation: files with the names that it uses.

They are short clips of real sequences, in the layouts of their datasets.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
from bag_file import BagFile

import corvo

FRAMES = 40
KITTI_FRAMES = 60
CAMERA = "model: pinhole-radtan\nwidth: 640\nheight: 480\nfx: 525\nfy: 525\ncx: 319.5\ncy: 239.5\n"
COMMANDS = {"corvo": "corvo", "corvo-bag": "corvo.pose_bag", "corvo-vslam-lab": "corvo.vslam_lab"}


def make_reader_folder(folder: Path, data: Path) -> None:
    _write_commands(folder / "bin")
    _write_kitti(folder / "dataset", data / "kitti")
    _write_euroc(folder / "MH_01_easy" / "mav0", data / "euroc" / "MH_01_easy" / "mav0")
    (folder / "rgbd_dataset_freiburg1_rpy").symlink_to(data / "tum" / "rgbd_dataset_freiburg1_rpy")
    _write_seven_scenes(folder / "redkitchen" / "seq-01", data / "7scenes" / "redkitchen")
    _write_own_images(folder)
    _render_freiburg1(folder)
    _write_bags(folder)
    _write_photographs(folder / "bsds500" / "train", data / "bsds500" / "train")


def environment(folder: Path) -> dict[str, str]:
    """Returns the variables with which commands run: the package's commands come first, then evo."""
    evo = Path(__file__).parents[2] / ".venv" / "bin"
    path = os.pathsep.join([str(folder / "bin"), os.environ["PATH"], str(evo)])
    home = {"HOME": str(folder), "MPLBACKEND": "agg"}  # Settings of the user play no part.
    return {**os.environ, "PATH": path, **home}


def _write_kitti(dataset: Path, data: Path) -> None:
    sequence = dataset / "sequences" / "03"
    (sequence / "image_0").mkdir(parents=True)
    (dataset / "poses").mkdir()
    shutil.copy(data / "sequences" / "03" / "calib.txt", sequence)
    for name in ["sequences/03/times.txt", "poses/03.txt"]:
        lines = (data / name).read_text().splitlines(keepends=True)[:KITTI_FRAMES]
        (dataset / name).write_text("".join(lines))
    for image in sorted((data / "sequences/03/image_0").iterdir())[:KITTI_FRAMES]:
        (sequence / "image_0" / image.name).symlink_to(image)


def _write_euroc(sequence: Path, data: Path) -> None:
    truth = "state_groundtruth_estimate0"
    (sequence / "cam0").mkdir(parents=True)
    (sequence / truth).symlink_to(data / truth)
    for name in ["sensor.yaml", "data"]:
        (sequence / "cam0" / name).symlink_to(data / "cam0" / name)
    rows = (data / "cam0" / "data.csv").read_text().splitlines(keepends=True)
    (sequence / "cam0" / "data.csv").write_text("".join(rows[: FRAMES + 1]))


def _write_seven_scenes(sequence: Path, data: Path) -> None:
    """Writes every third image, so that few show a long path, and a file for each pose."""
    sequence.mkdir(parents=True)
    _, poses = corvo.read_tum(data / "groundtruth.txt")
    for image, pose in list(zip(sorted(data.glob("*.color.*")), poses))[: 3 * FRAMES : 3]:
        (sequence / image.name).symlink_to(image)
        name = image.name.split(".")[0]
        np.savetxt(sequence / f"{name}.pose.txt", pose)


def _write_own_images(folder: Path) -> None:
    """Writes images, films and camera files of one's own."""
    (folder / "images").mkdir()
    for name in ["camera.yaml", "phone.yaml", "left.yaml"]:
        (folder / name).write_text(CAMERA)
    cv2.imwrite(str(folder / "bonnet.png"), np.full((480, 640), 255, np.uint8))
    codec = cv2.VideoWriter.fourcc(*"mp4v")
    film = cv2.VideoWriter(str(folder / "film.mp4"), codec, 30, (640, 480))
    sequence = folder / "redkitchen" / "seq-01"
    for i, image in enumerate(sorted(sequence.glob("*.color.*"))):
        (folder / "images" / f"left{i:04}{image.suffix}").symlink_to(image.resolve())
        film.write(cv2.imread(str(image)))
    film.release()
    shutil.copy(folder / "film.mp4", folder / "drive.mp4")


def _render_freiburg1(folder: Path) -> None:
    """Renders a sequence in TUM's layout, with what VSLAM-LAB writes about it."""
    name = "rgbd_dataset_freiburg1_xyz"
    options = ["--camera", "tum_fr1", "--frames", str(FRAMES), "-o", name]
    subprocess.run([folder / "bin" / "corvo", "synth", "room", *options], check=True, cwd=folder)
    rows = ["ts_rgb_0 (ns),path_rgb_0"]
    for line in (folder / name / "rgb.txt").read_text().splitlines():
        if not line.startswith("#"):
            seconds, image = line.split()
            rows.append(f"{int(float(seconds) * 1e9)},{image}")
    (folder / "rgb.csv").write_text("\n".join(rows) + "\n")
    (folder / "calibration.yaml").write_text(
        "cameras:\n- {cam_name: rgb_0, cam_type: rgb, cam_model: pinhole, "
        "focal_length: [517.3, 516.5], principal_point: [318.6, 255.3], "
        "image_dimension: [640, 480], fps: 30}\n"
    )


def _write_bags(folder: Path) -> None:
    camera = corvo.Camera.load(folder / "camera.yaml")
    images = sorted((folder / "images").iterdir())
    for name in ["film.bag", "folder.mcap", "film"]:
        with BagFile(folder / name) as bag:
            bag.write_camera("/cam0/camera_info", camera)
            for i, image in enumerate(images):
                pixels = cv2.imread(str(image), cv2.IMREAD_GRAYSCALE)
                bag.write_image("/cam0/image_raw", i * 10**9 // 30, "mono8", pixels)
    next((folder / "folder.mcap").glob("*.mcap")).rename(folder / "film.mcap")


def _write_photographs(folder: Path, data: Path) -> None:
    folder.mkdir(parents=True)
    for image in sorted(data.iterdir())[:10]:
        (folder / image.name).symlink_to(image)


def _write_commands(folder: Path) -> None:
    """Writes the commands that the package installs, for this interpreter."""
    folder.mkdir()
    for name, module in COMMANDS.items():
        script = folder / name
        script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m {module} "$@"\n')
        script.chmod(0o755)
    subprocess.run([folder / "corvo", "--version"], check=True, capture_output=True)
