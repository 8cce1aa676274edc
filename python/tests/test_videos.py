# SPDX-License-Identifier: MIT
import sys
from pathlib import Path

import pytest
from conftest import Sequence

import corvo


def test_a_video_needs_opencv(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "cv2", None)
    (tmp_path / "film.mp4").write_bytes(b"\0" * 100)
    with pytest.raises(corvo.Error, match=r"film.mp4: .* pip install corvo\[video\]"):
        corvo.run(tmp_path / "film.mp4", focal=500)


def test_a_video_is_tracked(room: Sequence, tmp_path: Path) -> None:
    cv2 = pytest.importorskip("cv2")
    film = str(tmp_path / "film.avi")
    writer = cv2.VideoWriter(film, cv2.VideoWriter_fourcc(*"MJPG"), 30, (640, 480))
    for image in room.images:
        writer.write(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR))
    writer.release()
    result = corvo.run(film, camera=room.camera)
    assert len(result.timestamps_ns) == len(room.images)
