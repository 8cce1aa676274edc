# SPDX-License-Identifier: MIT
"""The calibration of a camera from its videos, without a board."""

from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory

from corvo._corvo import Camera
from corvo.commands import Option, execute, option_arguments


def calibrate(*inputs: str | PathLike[str], **options: Option) -> Camera:
    """Calibrates a camera from sequences of one zoom and focus, as `corvo calibrate` does.

    Args:
        inputs: Folders or patterns of images, or videos, which need corvo[video].
        options: Any option of `corvo calibrate`, with _ for -: model="radtan", every=2.

    Returns:
        The camera with its standard deviations; str(camera) is the text of a camera file.

    Raises:
        Error: An argument is invalid, or no input could be tracked or adjusted.
    """
    with TemporaryDirectory(prefix="corvo_") as folder:
        file = Path(folder) / "camera.yaml"
        given = option_arguments({"output": file, **options})
        execute(["calibrate", *map(str, inputs), *given])
        return Camera.load(file)
