# SPDX-License-Identifier: MIT
"""corvo, which contains an OpenCV of its own, works in one process with opencv-python."""

import subprocess
import sys

import pytest

USE_BOTH = """
import numpy as np

image = np.random.default_rng(0).integers(0, 256, (240, 320), np.uint8)
camera = corvo.Camera(model="pinhole", width=320, height=240, fx=300, fy=300, cx=159.5, cy=119.5)
assert corvo.Odometry(camera).process(image, 0).world_from_camera is None
assert len(cv2.ORB_create(500).detect(image)) == 500
print("both work")
"""


@pytest.mark.parametrize("imports", ["import corvo, cv2", "import cv2, corvo"])
def test_works_beside_opencv(imports):
    pytest.importorskip("cv2")
    result = subprocess.run(
        [sys.executable, "-c", imports + USE_BOTH], capture_output=True, text=True, check=False
    )
    assert (result.returncode, result.stdout) == (0, "both work\n"), result.stderr
