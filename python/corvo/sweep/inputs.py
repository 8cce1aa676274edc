# SPDX-License-Identifier: MIT
"""The sequences that a plan names."""

import glob
import os
from dataclasses import dataclass, field
from pathlib import Path

from corvo._corvo import Error
from corvo.sweep.downloads import find_urls, is_url
from corvo.sweep.fields import Field, shown

_FILES = ("camera", "mask", "times", "gt")
"""Options of `corvo run` whose values may be files."""


@dataclass(frozen=True)
class Input:
    """A sequence, and how it is read."""

    name: str
    location: str
    """An absolute path, or a URL."""
    options: dict[str, str] = field(default_factory=dict)
    """Options of `corvo run` that say what is read and how; files as absolute paths."""
    count: int | None = None
    """Only so many first images are used, of which perturbations select some."""
    max_dt_s: float | None = None
    report_only: frozenset[str] = frozenset()
    """Titles of perturbations that medians and regressions leave out."""

    def files(self) -> dict[str, Path]:
        """Returns the files and folders that the options name."""
        given = {name: self.options[name] for name in _FILES if name in self.options}
        paths = {
            name: Path(text if Path(text).exists() else text.partition(":")[0])
            for name, text in given.items()
        }
        return {name: path for name, path in paths.items() if path.is_absolute()}


def run_arguments(location: str, options: dict[str, str]) -> list[str]:
    """Returns the arguments of `corvo run` that say what is read and how."""
    pairs = [("--" + name.replace("_", "-"), value) for name, value in options.items()]
    return [location, *(argument for pair in pairs for argument in pair)]


def read_inputs(inputs: Field, folder: Path) -> list[Input]:
    """Returns the inputs of a list. Relative paths are relative to the folder of the plan.

    Raises:
        Error: A key is unknown, a value is wrong, nothing matches a path, or names are equal.
    """
    found = [entry for item in inputs.items() for entry in _read_entry(item, folder)]
    if not found:
        raise inputs.error("a list that is not empty")
    names: set[str] = set()
    for entry in found:
        if entry.name in names:
            raise Error(
                f"{inputs.place} has two inputs of the name {shown(entry.name)}; allowed are "
                "different ones: set `name`, in which {} stands for the last part of the path"
            )
        names.add(entry.name)
    return found


def _read_entry(item: Field, folder: Path) -> list[Input]:
    values = item.mapping(
        ("path", "name", *_FILES, "focal", "fov", "fps", "bits", "resize", "topic", "count",
         "max_dt", "report_only")
    )  # fmt: skip
    if "path" not in values:
        raise Error(f"{item.place} has no path; allowed is a file, folder, pattern or URL")
    options = {key: _option(values[key], folder) for key in _option_keys(values)}
    count = values["count"].integer(1, 10**9) if "count" in values else None
    max_dt_s = values["max_dt"].number(0, 10**6) if "max_dt" in values else None
    only = values["report_only"].items() if "report_only" in values else []
    name = values["name"].text() if "name" in values else ""
    return [
        Input(_name(name, location), location, options, count, max_dt_s,
              frozenset(title.text() for title in only))
        for location in _locations(values["path"], folder)
    ]  # fmt: skip


def _option_keys(values: dict[str, Field]) -> list[str]:
    others = {"path", "name", "count", "max_dt", "report_only"}
    return sorted(key for key in values if key not in others)


def _option(value: Field, folder: Path) -> str:
    """Returns the value of an option of `corvo run`, which checks it when it reads the input."""
    if isinstance(value.value, bool) or not isinstance(value.value, (int, float, str)):
        raise value.error("a text or a number")
    text = _expand(value, str(value.value))
    file, _, name = text.partition(":")  # FILE:NAME is one of several cameras.
    if (folder / file).exists():
        path = str((folder / file).resolve())
        return f"{path}:{name}" if name else path
    return text


def _locations(path: Field, folder: Path) -> list[str]:
    text = _expand(path, path.text())
    if is_url(text):
        return find_urls(path.place, text)
    pattern = folder / text
    if not glob.has_magic(text):
        found = [pattern] if pattern.exists() else []
    else:
        found = [Path(match) for match in sorted(glob.glob(str(pattern), recursive=True))]
    if not found:
        raise path.error("a file, folder or pattern that exists")
    return [os.path.abspath(match) for match in found]


def _expand(value: Field, text: str) -> str:
    """Replaces variables of the environment."""
    expanded = os.path.expanduser(os.path.expandvars(text))
    if "$" in expanded:
        raise value.error("a text whose variables of the environment are set")
    return expanded


def _name(given: str, location: str) -> str:
    """Returns the given name, or else the last two parts of the path."""
    parts = [part for part in location.rstrip("/").split("/") if part]
    return given.replace("{}", parts[-1]) if given else "/".join(parts[-2:])
