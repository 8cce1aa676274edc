# SPDX-License-Identifier: MIT
"""corvo, which contains an OpenCV of its own, works in one process with opencv-python."""

import subprocess
import sys

import pytest

EXTRACT_BOTH = """
import numpy as np

image = np.random.default_rng(0).integers(0, 256, (240, 320), np.uint8)
print(len(corvo.orb.Extractor()(image).pixels) > 0, len(cv2.ORB_create().detect(image)) > 0)
"""


@pytest.mark.parametrize("imports", ["import corvo, cv2", "import cv2, corvo"])
def test_features_are_extracted_beside_opencv(imports: str) -> None:
    pytest.importorskip("cv2")
    result = subprocess.run(
        [sys.executable, "-c", imports + EXTRACT_BOTH], capture_output=True, text=True
    )
    assert (result.returncode, result.stdout) == (0, "True True\n"), result.stderr
