# SPDX-License-Identifier: MIT
"""The runs of a plan: each a sequence, under options and a perturbation."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import cache
from importlib.metadata import version
from typing import Any

from corvo import _corvo
from corvo.sweep.inputs import Input
from corvo.sweep.options import OptionSet
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.plan import Plan

_FORMAT = 1
"""Changes with what runs measure and with what perturbations do."""


@dataclass(frozen=True)
class Task:
    """A run.

    Runs with the same key give the same outcome: the key is a hash of the content of the input, of
    the effective options, of the perturbation, and of the build of corvo.
    """

    key: str
    content: str
    """The hash of the input."""
    input: Input
    options: OptionSet
    perturbation: Perturbation

    @property
    def is_judged(self) -> bool:
        return self.perturbation.title not in self.input.report_only


def make_tasks(plan: Plan, contents: Mapping[str, str], build: str) -> Iterator[Task]:
    """Yields the runs of a plan in its order.

    Args:
        plan: The plan.
        contents: The hash of each input by its name.
        build: That of corvo, as build_of_corvo() states it.
    """
    for entry in plan.inputs:
        content = contents[entry.name]
        for options in plan.options:
            for perturbation in plan.perturbations:
                key = _key(entry, content, options, perturbation, build)
                yield Task(key, content, entry, options, perturbation)


@cache
def build_of_corvo() -> str:
    """Returns the version and a hash of the program's own code."""
    with open(str(_corvo.__file__), "rb") as stream:
        code = hashlib.file_digest(stream, "sha256").hexdigest()
    return f"{version('corvo')}+{code[:12]}"


def _key(
    entry: Input, content: str, options: OptionSet, perturbation: Perturbation, build: str
) -> str:
    identity = {
        "format": _FORMAT,
        "corvo": build,
        "content": content,
        "reading": _reading(entry),
        "options": options.effective,
        "perturbation": asdict(perturbation),
    }
    text = json.dumps(identity, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _reading(entry: Input) -> dict[str, Any]:
    """Returns how an input is read. Files count by their content alone, wherever they lie."""
    files = entry.files()
    options = {
        name: value.removeprefix(str(files[name])) if name in files else value
        for name, value in entry.options.items()
    }
    return {**options, "count": entry.count, "max_dt": entry.max_dt_s}


def task_document(task: Task) -> dict[str, Any]:
    """Returns what the process of a run has to know, for JSON."""
    return {
        "key": task.key,
        "location": task.input.location,
        "reading": task.input.options,
        "count": task.input.count,
        "max_dt_s": task.input.max_dt_s,
        "options": task.options.effective,
        "perturbation": asdict(task.perturbation),
    }
