# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from conftest import Sequence
from numpy.typing import NDArray

import corvo

GRAY = np.zeros((480, 640), np.uint8)
INVALID = {
    "float64": (GRAY.astype(np.float64), "image has dtype float64; allowed is uint8"),
    "float32": (GRAY.astype(np.float32), "image has dtype float32; allowed is uint8"),
    "bool": (GRAY.astype(bool), "image has dtype bool; allowed is uint8"),
    "uint16": (GRAY.astype(np.uint16), "image has dtype uint16; allowed is uint8"),
    "int8": (GRAY.astype(np.int8), "image has dtype int8; allowed is uint8"),
    "object": (GRAY.astype(object), "image has dtype object; allowed is uint8"),
    "a row": (GRAY[0], r"image has shape \(640,\); allowed is \(height, width\)"),
    "one channel": (GRAY[:, :, None], r"image has shape \(480, 640, 1\); allowed"),
    "four channels": (np.zeros((480, 640, 4), np.uint8), r"shape \(480, 640, 4\); allowed"),
    "no rows": (GRAY[:0], r"image has shape \(0, 640\); allowed"),
    "mirrored": (GRAY[:, ::-1], r"image has strides \(640, -1\); allowed is contiguous rows"),
    "flipped": (GRAY[::-1], r"image has strides \(-640, 1\); allowed is contiguous rows"),
    "by columns": (np.asfortranarray(GRAY), r"image has strides \(1, 480\); allowed"),
    "one row for all": (np.broadcast_to(GRAY[0], GRAY.shape), r"image has strides \(0, 1\)"),
    "another size": (GRAY[:100], "image is 640x100; the camera says 640x480"),
    "a list": ([[0]], "image has type list; allowed is a NumPy array"),
    "nothing": (None, "image has type NoneType; allowed is a NumPy array"),
}


@pytest.mark.parametrize("image, message", INVALID.values(), ids=INVALID.keys())
def test_nothing_is_converted_silently(room: Sequence, image: object, message: str) -> None:
    with pytest.raises(corvo.Error, match=message):
        corvo.Odometry(room.camera).process(image, 0)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "mask, message",
    [
        (GRAY.astype(bool), "mask has dtype bool; allowed is uint8"),
        (GRAY[:10], "mask is 640x10; allowed is the image's size, 640x480"),
        (np.zeros((480, 640, 3), np.uint8), r"mask has shape \(480, 640, 3\); allowed"),
    ],
)
def test_masks_are_checked(room: Sequence, mask: NDArray[np.uint8], message: str) -> None:
    with pytest.raises(corvo.Error, match=message):
        corvo.Odometry(room.camera).process(GRAY, 0, mask)


def test_an_error_is_a_value_error() -> None:
    assert issubclass(corvo.Error, ValueError)


def test_rows_may_lie_apart(room: Sequence) -> None:
    image = room.images[0]
    wide = np.zeros((480, 1000), np.uint8)
    wide[:, 100:740] = image
    extract = corvo.orb.Extractor()
    np.testing.assert_array_equal(
        extract(wide[:, 100:740]).descriptors, extract(image).descriptors
    )


def test_color_is_weighted_like_luma(room: Sequence) -> None:
    color = np.stack([np.roll(room.images[0], 7 * shift, axis=1) for shift in range(3)], axis=2)
    # The fixed-point weights of OpenCV, with 15 bits.
    weighted = color.astype(np.int64) @ np.array([9798, 19235, 3735]) + (1 << 14)
    gray = (weighted >> 15).astype(np.uint8)
    extract = corvo.orb.Extractor()
    np.testing.assert_array_equal(extract(color).pixels, extract(gray).pixels)
    np.testing.assert_array_equal(extract(color).descriptors, extract(gray).descriptors)


def test_a_mask_excludes_keypoints(room: Sequence) -> None:
    mask = np.zeros((480, 640), np.uint8)
    mask[:, 320:] = 1
    pixels = corvo.orb.Extractor()(room.images[0], mask).pixels
    assert len(pixels) > 100
    assert pixels[:, 0].min() > 300
