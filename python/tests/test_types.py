# SPDX-License-Identifier: MIT
import os
import subprocess
import sys
from pathlib import Path

import corvo

EXAMPLE = '''
import numpy as np
import corvo

camera = corvo.Camera.load("tum_fr1")
odometry = corvo.Odometry(camera, corvo.Options({"tracker": {"min_inliers": 20}}))
frame = odometry.process(np.zeros((480, 640), np.uint8), 0)
reveal_type(frame.state)
odometry.process("image", 0)
'''


def test_the_package_is_typed(tmp_path: Path) -> None:
    assert (Path(corvo.__file__).parent / "py.typed").exists()
    (tmp_path / "example.py").write_text(EXAMPLE)
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), "example.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    lines = checked.stdout.splitlines()
    assert lines[0].endswith('Revealed type is "str"'), checked.stdout
    assert "[arg-type]" in lines[1]
    assert lines[-1].startswith("Found 1 error in 1 file")


def test_the_package_passes_the_type_check(tmp_path: Path) -> None:
    settings = Path(__file__).parents[2] / "pyproject.toml"
    options = ["--config-file", str(settings), "--cache-dir", str(tmp_path)]
    packages = Path(corvo.__file__).parents[1]
    is_installed = packages.name == "site-packages"  # mypy looks there by itself.
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", *options, "-p", "corvo"],
        env=dict(os.environ) if is_installed else {**os.environ, "MYPYPATH": str(packages)},
        capture_output=True,
        text=True,
    )
    assert checked.returncode == 0, checked.stdout


def test_everything_public_has_a_docstring() -> None:
    public = [getattr(corvo, name) for name in corvo.__all__]
    assert [item for item in public if not item.__doc__] == []
