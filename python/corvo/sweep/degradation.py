# SPDX-License-Identifier: MIT
"""What perturbations do to the pixels of an image."""

from io import BytesIO

import numpy as np
from numpy.typing import NDArray

from corvo.sweep.perturbation import Perturbation, gain_factor

Image = NDArray[np.uint8]

_TEXTURE_BLOCK = 8
"""Side of the squares of an overlay, px."""


def degrade(image: Image, perturbation: Perturbation, index: int) -> Image:
    """Returns the image with an index after overlay, gain, noise and compression, in this order.

    It depends on the arguments alone.
    """
    if perturbation.overlay > 0:
        image = _overlay(image, perturbation.overlay)
    if perturbation.gain > 0:
        image = _rounded(image * gain_factor(perturbation, index))
    if perturbation.noise > 0:
        random = np.random.Generator(np.random.PCG64(1 + index))
        noise = random.standard_normal(image.shape, np.float32)
        image = _rounded(image + np.float32(perturbation.noise) * noise)
    if perturbation.jpeg > 0:
        image = _compress(image, perturbation.jpeg)
    return image


def _rounded(values: NDArray[np.floating]) -> Image:
    """Returns the nearest gray levels, halves to even."""
    levels: Image = np.clip(np.rint(values), 0, 255).astype(np.uint8)
    return levels


def _overlay(image: Image, share: float) -> Image:
    """Replaces the lower rows by a texture that is the same for all images of a size."""
    height, width = image.shape
    first = round((1 - share) * height)
    blocks = (height // _TEXTURE_BLOCK + 1, width // _TEXTURE_BLOCK + 1)
    levels = np.random.RandomState(0).randint(0, 256, blocks).astype(np.uint8)
    texture = levels.repeat(_TEXTURE_BLOCK, 0).repeat(_TEXTURE_BLOCK, 1)
    return np.concatenate([image[:first], texture[first:height, :width]])


def _compress(image: Image, quality: int) -> Image:
    from PIL import Image as pillow  # Only compression takes the time to load it.

    buffer = BytesIO()
    pillow.fromarray(image).save(buffer, "JPEG", quality=quality)
    return np.asarray(pillow.open(buffer))
