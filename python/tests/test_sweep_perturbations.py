# SPDX-License-Identifier: MIT
"""Perturbations of `corvo sweep`: exact on small images and sequences."""

import math
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sweep_support  # noqa: F401  Skips without corvo[sweep].
from conftest import Sequence as Room
from PIL import Image

from corvo.quaternion import quaternion
from corvo.sweep.degradation import degrade
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.sequence import Frame, Sequence

GRAY = np.arange(48, dtype=np.uint8).reshape(6, 8) * 5


def test_no_perturbation_changes_nothing() -> None:
    assert degrade(GRAY, Perturbation(), 7) is GRAY
    assert Perturbation().title == "none"


def test_gain_multiplies_and_rounds_to_the_nearest_level() -> None:
    quarter = degrade(GRAY, Perturbation(gain=0.1), 13)  # Just beyond a quarter of the period.
    factor = 1 + 0.1 * math.sin(2 * math.pi * 13 / 50)
    expected = [[min(255, round(factor * int(level))) for level in row] for row in GRAY]
    assert quarter.tolist() == expected
    assert quarter.max() == 255
    assert degrade(GRAY, Perturbation(gain=0.1), 50).tolist() == GRAY.tolist()


def test_noise_has_its_standard_deviation_and_differs_from_image_to_image() -> None:
    image = np.full((200, 300), 128, np.uint8)
    first, again, second = (degrade(image, Perturbation(noise=5), i) for i in (0, 0, 1))
    assert (first == again).all()
    errors = [noisy.astype(float) - 128 for noisy in (first, second)]
    for error in errors:
        assert error.mean() == pytest.approx(0, abs=5 * 5 / math.sqrt(image.size))
        assert error.std() == pytest.approx(math.hypot(5, 1 / math.sqrt(12)), rel=0.02)
    assert np.corrcoef(errors[0].ravel(), errors[1].ravel())[0, 1] == pytest.approx(0, abs=0.02)


def test_noise_stays_within_gray_levels() -> None:
    noisy = degrade(np.array([[0, 255]] * 100, np.uint8), Perturbation(noise=20), 0)
    assert noisy[:, 0].min() == 0 and noisy[:, 0].max() < 128
    assert noisy[:, 1].max() == 255 and noisy[:, 1].min() > 128


def test_compression_is_that_of_jpeg() -> None:
    smooth = np.tile(np.arange(64, dtype=np.uint8) * 2, (64, 1))
    buffer = BytesIO()
    Image.fromarray(smooth).save(buffer, "JPEG", quality=50)
    compressed = degrade(smooth, Perturbation(jpeg=50), 0)
    assert (compressed == np.asarray(Image.open(buffer))).all()
    assert 0 < np.abs(compressed.astype(int) - smooth).max() < 20


def test_an_overlay_covers_the_lower_rows_with_the_same_texture() -> None:
    images = [np.full((100, 60), level, np.uint8) for level in (10, 200)]
    covered = [degrade(image, Perturbation(overlay=0.25), i) for i, image in enumerate(images)]
    assert (covered[0][:75] == 10).all() and (covered[1][:75] == 200).all()
    assert (covered[0][75:] == covered[1][75:]).all()
    assert covered[0][75:].std() > 50
    assert covered[0].shape == (100, 60)


def test_noise_comes_after_gain_and_compression_last() -> None:
    image = np.full((16, 16), 100, np.uint8)
    together = degrade(image, Perturbation(noise=5, gain=0.2, jpeg=80), 3)
    brighter = degrade(image, Perturbation(gain=0.2), 3)
    noisy = degrade(brighter, Perturbation(noise=5), 3)
    assert (together == degrade(noisy, Perturbation(jpeg=80), 3)).all()


SECOND = 10**9


@pytest.fixture(scope="module")
def numbered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten images a second apart, the i-th of the gray level i."""
    folder = tmp_path_factory.mktemp("numbered")
    for i in range(10):
        Image.fromarray(np.full((48, 64), i, np.uint8)).save(folder / f"{i:02}.png")
    return folder


def frames(folder: Path, count: int | None = None, **perturbation: Any) -> list[Frame]:
    options = {"fov": "60", "fps": "1"}
    return list(Sequence(str(folder), options, count, Perturbation(**perturbation)).frames())


def levels(sequence: list[Frame]) -> list[int]:
    return [int(frame.image[0, 0]) for frame in sequence if frame.image is not None]


def seconds(sequence: list[Frame]) -> list[float]:
    return [frame.time_ns / SECOND for frame in sequence]


def true_seconds(sequence: list[Frame]) -> list[float | None]:
    return [f.true_time_ns / SECOND if f.true_time_ns is not None else None for f in sequence]


def test_start_and_stride_select_images(numbered: Path) -> None:
    selected = frames(numbered, start=3, stride=2)
    assert levels(selected) == [3, 5, 7, 9]
    assert seconds(selected) == true_seconds(selected) == [3, 5, 7, 9]


@pytest.mark.parametrize(
    ("start", "stride", "expected"), [(0, 1, [0, 1, 2, 3, 4]), (1, 2, [1, 3]), (2, 2, [2, 4])]
)
def test_a_perturbation_selects_among_the_first_images(
    numbered: Path, start: int, stride: int, expected: list[int]
) -> None:
    assert levels(frames(numbered, 5, start=start, stride=stride)) == expected


def test_reversal_mirrors_times_but_not_those_of_the_truth(numbered: Path) -> None:
    turned = frames(numbered, start=6, reversal=True)
    assert levels(turned) == [9, 8, 7, 6]
    assert seconds(turned) == [6, 7, 8, 9]
    assert true_seconds(turned) == [9, 8, 7, 6]


def test_repetitions_come_between_images_and_have_no_truth(numbered: Path) -> None:
    repeated = frames(numbered, 5, repetition=2)
    assert levels(repeated) == [0, 1, 1, 2, 3, 3, 4]
    assert seconds(repeated) == [0, 1, 1.5, 2, 3, 3.5, 4]
    assert true_seconds(repeated) == [0, 1, None, 2, 3, None, 4]


def test_later_passes_follow_on_and_have_no_truth(numbered: Path) -> None:
    passes = frames(numbered, start=7, passes=2, reversal=True)
    assert levels(passes) == [9, 8, 7, 9, 8, 7]
    assert seconds(passes) == [7, 8, 9, 10, 11, 12]
    assert true_seconds(passes) == [9, 8, 7, None, None, None]


def test_gain_depends_on_the_index_in_the_recording(room: Room) -> None:
    options = {"fov": "60"}
    sequence = Sequence(str(room.folder), options, 10, Perturbation(start=3, stride=2, gain=0.5))
    second = list(sequence.frames())[1].image
    assert second is not None
    assert (second == degrade(room.images[5], Perturbation(gain=0.5), 5)).all()


@pytest.mark.parametrize(
    "expected", [(0, 0, 0, 1), (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0.5, -0.5, 0.5, -0.5)]
)
def test_quaternions_are_those_of_the_rotation(expected: tuple[float, ...]) -> None:
    x, y, z, w = expected
    rotation = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    assert abs(quaternion(rotation) @ expected) == pytest.approx(1, abs=1e-15)
