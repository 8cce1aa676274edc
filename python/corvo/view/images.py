# SPDX-License-Identifier: MIT
"""The images of the view: reduced, tinted where they are masked, compressed."""

from io import BytesIO

import numpy as np
import rerun as rr
from numpy.typing import NDArray
from PIL import Image

from corvo.view import colors

MAX_PIXELS = 400_000
"""Images with more pixels are reduced by a whole factor, so that a recording stays small."""

JPEG_QUALITY = 75
_TINT_SHARE = 0.4


def reduction(width: int, height: int) -> int:
    """Returns the factor by which both sides of images of that size are reduced, at least 1."""
    return max(1, int(np.ceil(np.sqrt(width * height / MAX_PIXELS))))


def encode(
    image: NDArray[np.uint8], mask: NDArray[np.uint8] | None, factor: int
) -> rr.EncodedImage:
    """Reduces an image, tints what is masked and compresses it.

    Args:
        image: Shape (height, width) or (height, width, 3), RGB.
        mask: Shape (height, width), 0 where no features are detected; or None.
        factor: By which both sides are reduced.
    """
    picture = Image.fromarray(image)
    if mask is not None and not mask.all():
        picture = _tinted(picture, mask)
    buffer = BytesIO()
    picture.reduce(factor).save(buffer, format="JPEG", quality=JPEG_QUALITY)
    return rr.EncodedImage(contents=buffer.getvalue(), media_type="image/jpeg")


def _tinted(picture: Image.Image, mask: NDArray[np.uint8]) -> Image.Image:
    picture = picture.convert("RGB")
    tint = Image.new("RGB", picture.size, colors.MASK)
    is_masked = Image.fromarray(mask == 0)
    return Image.composite(Image.blend(picture, tint, _TINT_SHARE), picture, is_masked)
