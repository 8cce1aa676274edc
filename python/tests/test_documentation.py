# SPDX-License-Identifier: MIT
"""The README and docs/: every command and program in them runs, and generated parts are up to date."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest
from conftest import command
from documentation import PAGES, ROOT, SHELL, blocks, commands, programs

import corvo

pytest.importorskip("cv2")
pytest.importorskip("rosbags")
from reader_folder import CAMERA, environment, make_reader_folder  # noqa: E402

NOT_RUN = {
    "bash scripts/": "builds, installs or measures for minutes to hours",
    "cmake ": "builds or installs; continuous integration does",
    "ctest ": "continuous integration does",
    "build/release/": "is the benchmarks' program, which measures for minutes",
    "PYTHONPATH=build/release/python ": "needs a build folder; these are its tests",
    "pip install ": "needs a network; scripts/test_wheel.sh does",
    "python3 -m venv ": "is followed by the installation; scripts/test_wheel.sh does",
    "rerun ": "opens a window",
    "corvo view result/03": "opens a window; python/tests/test_view.py records what it shows",
    "corvo view drive.mp4 --focal auto": "opens a window",
    "corvo run camera:0": "needs a connected camera",
    "corvo sweep plan.yaml": "takes minutes; python/tests/test_sweep_runs.py runs smaller plans",
    "import duckdb": "needs the rows of a sweep; python/tests/test_sweep_runs.py reads them",
    "sudo ": "needs root; scripts/test_packages.sh and scripts/build_arm64.sh do",
    "docker ": "needs Docker",
    "rattler-build ": "needs conda-forge",
}
"""Beginnings of commands that are not run, and why."""

NOT_HERE = ["drive_0001", "room1", "sequence_30", "P000"]
"""Parts of commands on datasets without a clip here; the test ReadmeCommands runs these on tiny folders."""

SUBSTITUTES = {
    r"^(corvo synth room .*)": r"\1 --frames 40",  # 300 frames take longer, and show nothing else.
    r"^(corvo learn bsds500/train .*)": r"\1 --keypoints 2000",
    r"images/left\*\.png": "images/left*.jpg",
    r" -d 100 -u m ": " -d 30 -u m ",  # The clip is 45 m long.
    r"^(corvo calibrate .*) -o camera\.yaml": r"\1 -o calibrated.yaml",  # camera.yaml is an input, too.
    r"\bRESULT\b": "result/mh_01",
    r"\btruth\.txt\b": "result/drive/trajectory.tum",
    r"view\.show\(stream\)": 'view.save_to(stream, "drive.rrd")',
}
"""What is replaced in commands and programs before they run."""

EXIT_CODES = {"corvo run rgbd_dataset_freiburg1_rpy": 2}
"""Commands whose exit code is not 0: that camera only turns, so no frame has a pose."""

PRELUDE = """\
from pathlib import Path

import numpy as np
from PIL import Image

import corvo

_files = sorted(Path("images").iterdir())[:20]
images = [(i * 33_333_333, np.asarray(Image.open(f).convert("L"))) for i, f in enumerate(_files)]
(timestamp_ns, image), image_1, image_2 = images[0], images[0][1], images[4][1]
camera = corvo.Camera.load("camera.yaml")
"""
"""The variables that programs in the documentation take as given."""


def starts_with_any(text: str, beginnings: Iterable[str]) -> bool:
    return any(text.startswith(beginning) for beginning in beginnings)


def is_run(text: str) -> bool:
    return not starts_with_any(text, NOT_RUN) and not any(name in text for name in NOT_HERE)


def substitute(text: str) -> str:
    for pattern, replacement in SUBSTITUTES.items():
        text = re.sub(pattern, replacement, text)
    return text


@pytest.fixture(scope="module")
def reader(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a reader who has run the first commands of the README.

    Tests are skipped without evo, or fail if CI is set.
    """
    if not (shutil.which("evo_ape") or (ROOT / ".venv/bin/evo_ape").exists()):
        if os.environ.get("CI"):
            pytest.fail("evo_ape is not installed")
        pytest.skip("evo_ape is not installed")
    folder = tmp_path_factory.mktemp("reader")
    make_reader_folder(folder, data)
    sequence = "dataset/sequences/03 --gt dataset/poses/03.txt"
    for options in [
        f"{sequence} -o result/03",
        f"{sequence} --refine -o result/03_refined",
        "MH_01_easy -o result/mh_01",
        "drive.mp4 --camera phone.yaml -o result/drive",
    ]:
        execute(f"corvo run {options}", folder)
    return folder


def execute(text: str, folder: Path) -> None:
    process = subprocess.run(
        ["bash", "-c", text], cwd=folder, env=environment(folder), capture_output=True, text=True
    )
    expected = next((code for start, code in EXIT_CODES.items() if text.startswith(start)), 0)
    assert process.returncode == expected, f"{text}\n{process.stdout}\n{process.stderr}"


@pytest.mark.parametrize("page", PAGES)
def test_commands_and_programs_run(page: str, reader: Path, tmp_path: Path) -> None:
    here = tmp_path / "here"
    shutil.copytree(reader, here, symlinks=True)
    for line, text in commands(page):
        if is_run(text):
            print(f"{page}:{line}")
            execute(substitute(text), here)
    texts = [block.text for block in programs(page) if is_run(block.text)]
    if texts:
        (here / "program.py").write_text(substitute("\n".join([PRELUDE, *texts])))
        execute(f'"{sys.executable}" program.py', here)


def test_no_exception_is_out_of_date() -> None:
    texts = [text for page in PAGES for _, text in commands(page)]
    sources = texts + [block.text for page in PAGES for block in programs(page)]
    for beginning in [*NOT_RUN, *EXIT_CODES]:
        assert any(text.startswith(beginning) for text in sources), beginning
    for name in NOT_HERE:
        assert any(name in text for text in texts), name
    for pattern in SUBSTITUTES:
        assert any(re.search(pattern, text) for text in sources if is_run(text)), pattern


def test_commands_that_are_not_run_name_files_that_exist() -> None:
    for page in PAGES:
        for line, text in commands(page):
            for path in re.findall(r"\bscripts/[\w/.]+", text):
                assert (ROOT / path).is_file(), f"{page}:{line}: {path}"


def test_commands_are_marked_as_such() -> None:
    for page in PAGES:
        for block in blocks(page):
            if block.language not in SHELL:
                assert not re.search(r"^(\$ |corvo |bash |pip )", block.text, re.M), (
                    f"{page}:{block.line}"
                )


def test_camera_files_in_the_text_are_read(tmp_path: Path) -> None:
    texts = [block.text for page in PAGES for block in blocks(page) if block.language == "yaml"]
    assert any("model:" in text for text in texts)
    for i, text in enumerate(texts):
        if text.startswith("inputs:"):  # The plan of a sweep.
            continue
        file = tmp_path / f"{i}.yaml"
        file.write_text(text if "model:" in text else CAMERA + text)
        corvo.Camera.load(file)


def test_the_page_of_options_is_that_of_the_command() -> None:
    script = ROOT / "scripts" / "site" / "make_options_page.py"
    process = subprocess.run(
        [sys.executable, script, *command()], check=True, capture_output=True, text=True
    )
    page = ROOT / "docs" / "options.md"
    assert process.stdout == page.read_text(), f"{script} CORVO > {page} updates it"


def test_every_reason_has_its_row() -> None:
    source = (ROOT / "vo" / "core" / "frame_result.cpp").read_text()
    function = source[source.index("ToString(Reason") :]
    reasons = re.findall(r'case .*\n +return "(\w+)"', function[: function.index("\n}")])
    assert len(reasons) == len(set(reasons)) > 10
    page = (ROOT / "docs" / "troubleshooting.md").read_text()
    table = page[page.index("## Reasons") : page.index("## States")]
    assert set(re.findall(r"^\| `(\w+)` \|", table, re.M)) == set(reasons)
