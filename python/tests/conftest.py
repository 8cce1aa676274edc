# SPDX-License-Identifier: MIT
"""A rendered sequence, its images as arrays, and what the command makes of it."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from decimal import Decimal
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

import corvo

if TYPE_CHECKING:
    from playwright.sync_api import Browser

NUM_FRAMES = 80
BLACK_FRAMES = range(30, 45)


class Sequence(NamedTuple):
    folder: Path
    camera: corvo.Camera
    images: list[NDArray[np.uint8]]
    timestamps_ns: list[int]

    def process(self, odometry: corvo.Odometry) -> list[corvo.ProcessedFrame]:
        return [odometry.process(*frame) for frame in zip(self.images, self.timestamps_ns)]


def command(*arguments: object) -> list[str]:
    """The command line of the command: that of CORVO_COMMAND, or the package's own."""
    program = os.environ.get("CORVO_COMMAND")
    start = [program] if program else [sys.executable, "-m", "corvo"]
    return start + [str(argument) for argument in arguments]


@pytest.fixture(scope="session")
def room(tmp_path_factory: pytest.TempPathFactory) -> Sequence:
    folder = tmp_path_factory.mktemp("synthetic") / "room"
    subprocess.run(command("synth", "room", "--frames", NUM_FRAMES, "-o", folder), check=True)
    rows = [line.split() for line in (folder / "rgb.txt").read_text().splitlines()]
    rows = [row for row in rows if row[0] != "#"]
    return Sequence(
        folder,
        corvo.Camera.load(folder / "camera.yaml"),
        [np.asarray(Image.open(folder / name)) for _, name in rows],
        [int(Decimal(seconds) * 10**9) for seconds, _ in rows],
    )


@pytest.fixture(scope="session")
def command_result(room: Sequence, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The result folder of the command for the rendered sequence."""
    folder = tmp_path_factory.mktemp("command") / "result"
    camera = room.folder / "camera.yaml"
    subprocess.run(
        command("run", room.folder, "--camera", camera, "-o", folder, "--quiet"), check=True
    )
    return folder


@pytest.fixture(scope="session")
def lost_result(room: Sequence, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The result for images some of which are black; it has no ground truth."""
    folder = tmp_path_factory.mktemp("lost")
    (folder / "images").mkdir()
    for i, image in enumerate(room.images):
        shown = np.zeros_like(image) if i in BLACK_FRAMES else image
        Image.fromarray(shown).save(folder / "images" / f"{i:04}.png")
    options = ["--camera", room.folder / "camera.yaml", "-o", folder / "lost", "--quiet"]
    subprocess.run(command("run", folder / "images", *options), check=False)
    return folder / "lost"


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real images; tests are skipped without it, or fail if CI is set."""
    folder = os.environ.get("CORVO_DATA")
    if folder and Path(folder).is_dir():
        return Path(folder)
    if os.environ.get("CI"):
        pytest.fail("CORVO_DATA names no folder of real images")
    pytest.skip("CORVO_DATA names no folder of real images")


@pytest.fixture(scope="module")
def browser() -> "Iterator[Browser]":
    """Tests are skipped without a browser, or fail if CI is set."""
    chromium = shutil.which("chromium")
    if chromium is None or find_spec("playwright") is None:
        missing = "chromium" if chromium is None else "playwright"
        if os.environ.get("CI"):
            pytest.fail(f"{missing} is not installed")
        pytest.skip(f"{missing} is not installed")
    from playwright.sync_api import sync_playwright

    arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=chromium, args=arguments)
        yield opened
        opened.close()
