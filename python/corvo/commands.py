# SPDX-License-Identifier: MIT
"""Commands that are executed in this process."""

import signal
import sys
from os import PathLike
from pathlib import Path

from corvo import _corvo

Option = bool | int | float | str | PathLike[str] | None


def option_arguments(options: dict[str, Option]) -> list[str]:
    """Returns the arguments of options that are given as keywords: max_dt=0.1 is --max-dt 0.1.

    True stands for a flag; an option that is None or False is left out.
    """
    arguments = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        arguments.append("--" + name.replace("_", "-"))
        if value is not True:
            arguments.append(str(value))
    return arguments


def execute(arguments: list[str]) -> int:
    """Executes a command without output, and returns its exit code.

    A signal that has ended the command is raised again: KeyboardInterrupt for Ctrl-C.

    Raises:
        Error: The message is that of the command.
    """
    exit_code, message = _corvo._execute([*arguments, "--quiet"])
    if exit_code > 128:
        signal.raise_signal(exit_code - 128)
    if message:
        raise _corvo.Error(message)
    return exit_code


def report(error: _corvo.Error) -> int:
    """Prints an error as the command does, and returns the exit code of a bad input."""
    print(f"corvo: error: {error}", file=sys.stderr)
    return 1


def write_text(folder: Path, name: str, value: object) -> Path:
    """Writes the text of a Camera or of Options into a folder, and returns the file."""
    file = folder / name
    file.write_text(str(value), encoding="utf-8")
    return file
