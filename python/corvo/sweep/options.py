# SPDX-License-Identifier: MIT
"""The options of the odometry that a plan compares."""

import re
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import yaml

from corvo._corvo import Error, Options
from corvo.sweep.fields import Field

Settings = dict[str, Any]
"""Values by "section.field"."""


@dataclass(frozen=True)
class OptionSet:
    label: str
    """What the grid sets, or "base"."""
    effective: dict[str, dict[str, Any]]
    """Every field of every section."""


def read_options(field: Field, folder: Path) -> list[OptionSet]:
    """Returns the base with each point of its grids.

    Raises:
        Error: A field is unknown, or a value has the wrong type or is out of range.
    """
    values = field.mapping(("config", "base", "grid"))
    settings: Settings = {}
    if "config" in values:
        settings |= _read_file(values["config"], folder)
    if "base" in values:
        settings |= {key: value.value for key, value in values["base"].mapping().items()}
    _effective(values.get("base", field), settings)
    if "grid" not in values:
        return [OptionSet("base", _effective(field, settings))]
    return [
        OptionSet(_label(point), _effective(grid, settings | point))
        for grid in values["grid"].items_or_self()
        for point in _points(grid)
    ]


def _read_file(field: Field, folder: Path) -> Settings:
    options = _parse(Options.load(folder / field.text()))
    return {f"{name}.{key}": value for name, keys in options.items() for key, value in keys.items()}


def _points(grid: Field) -> list[Settings]:
    axes = grid.mapping()
    if not axes:
        raise grid.error("a mapping of fields to lists of values")
    values = [[value.value for value in axis.items_or_self()] for axis in axes.values()]
    if [] in values:
        raise grid.error("a mapping of fields to lists that are not empty")
    return [dict(zip(axes, point)) for point in product(*values)]


def _effective(field: Field, settings: Settings) -> dict[str, dict[str, Any]]:
    sections: dict[str, dict[str, Any]] = {}
    for key, value in settings.items():
        section, dot, name = key.partition(".")
        if not dot:
            raise Error(f"{field.place} has the key {key}; allowed is section.field")
        sections.setdefault(section, {})[name] = value
    try:
        options = Options(sections)
    except (Error, TypeError) as error:
        message = re.sub("^options:[0-9]+: ", "", str(error))  # A line of no file.
        raise Error(f"{field.place}: {message}") from None
    return _parse(options)


def _parse(options: Options) -> dict[str, dict[str, Any]]:
    # The loader in C, where PyYAML has it, takes a tenth of the time.
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    sections: dict[str, dict[str, Any]] = yaml.load(str(options), loader)
    return sections


def _label(point: Settings) -> str:
    return ", ".join(f"{key}={_shown(value)}" for key, value in point.items())


def _shown(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
