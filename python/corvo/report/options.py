# SPDX-License-Identifier: MIT
"""The options that were in effect, beside their defaults."""

from typing import NamedTuple

from corvo._corvo import Options
from corvo.result import Result

_INPUT_KEYS = (
    "start", "every", "count", "resize", "mask", "fps", "times", "bits", "topic",
    "meters_per_unit", "camera_height", "known_distance", "known_size",
)  # fmt: skip


class Option(NamedTuple):
    meaning: str
    value: str


def read_options(result: Result) -> dict[str, Option]:
    """Returns the options of a run by section.key."""
    return parse_options(str(Options.load(result.file("config.yaml"))))


def default_options() -> dict[str, Option]:
    return parse_options(str(Options()))


def input_options(result: Result) -> dict[str, str]:
    """Returns what a run was given beside the configuration, by the names of summary.json."""
    return {key: str(result.summary[key]) for key in _INPUT_KEYS if key in result.summary}


def parse_options(text: str) -> dict[str, Option]:
    """Parses the text of Options: sections of keys, each after a comment with its meaning."""
    options: dict[str, Option] = {}
    section = meaning = ""
    for line in text.splitlines():
        content = line.strip()
        if content.startswith("#"):
            meaning = content[1:].strip()
        elif content.endswith(":") and not line.startswith(" "):
            section = content[:-1]
        elif content:
            key, _, value = content.partition(": ")
            options[f"{section}.{key}"] = Option(meaning, value)
    return options
