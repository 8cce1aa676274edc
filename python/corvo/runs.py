# SPDX-License-Identifier: MIT
"""Runs of whole sequences, as the command `corvo run` does them, and exports of their results."""

from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory

from corvo._corvo import Camera, Options
from corvo.commands import Option, execute, option_arguments, write_text
from corvo.result import Result


def run(
    input: str | PathLike[str],
    *,
    output: str | PathLike[str] | None = None,
    camera: Camera | str | PathLike[str] | None = None,
    config: Options | str | PathLike[str] | None = None,
    **options: Option,
) -> Result:
    """Runs the odometry on a sequence, as `corvo run` does.

    Args:
        input: A dataset, a folder or pattern of images, or a video, which needs corvo[video].
        output: The folder for the results; a temporary one if left out.
        camera: A camera, or what --camera takes: a calibration file or a shipped camera's name.
        config: Options, or an options file.
        options: Any other option of `corvo run`, with _ for -: focal="auto", refine=True, every=2.

    Ctrl-C ends the run, writes what it has found, and raises KeyboardInterrupt.

    Raises:
        Error: An argument or the input is invalid, or the run ended early.
    """
    temporary = None
    if output is None:
        temporary = TemporaryDirectory(prefix="corvo_")
        output = Path(temporary.name) / "result"
    with TemporaryDirectory(prefix="corvo_") as inputs:
        if isinstance(camera, Camera):
            camera = write_text(Path(inputs), "camera.yaml", camera)
        if isinstance(config, Options):
            config = write_text(Path(inputs), "config.yaml", config)
        given = option_arguments({"camera": camera, "config": config, **options})
        execute(["run", str(input), "--output", str(output), *given])
    return Result(output, temporary)


def export(
    result: Result | str | PathLike[str],
    *,
    to: str,
    output: str | PathLike[str],
    **options: Option,
) -> Path:
    """Writes a result for other programs, as `corvo export` does, and returns the folder.

    Args:
        result: A result, or its folder.
        to: "colmap" or "nerfstudio".
        output: The folder for the export.
        options: Any other option of `corvo export`, with _ for -: images=True, frames="all".

    Raises:
        Error: An argument is invalid, or the result cannot be exported.
    """
    folder = result.folder if isinstance(result, Result) else result
    given = option_arguments({"to": to, "output": output, **options})
    execute(["export", str(folder), *given])
    return Path(output)
