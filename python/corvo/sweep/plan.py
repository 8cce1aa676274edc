# SPDX-License-Identifier: MIT
"""The plan of a sweep, as a YAML file states it."""

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import yaml

from corvo._corvo import Error
from corvo.sweep.fields import Field
from corvo.sweep.inputs import Input, read_inputs
from corvo.sweep.limits import Limits, read_limits
from corvo.sweep.metrics import DEFAULT_METRICS, read_metrics
from corvo.sweep.options import OptionSet, read_options
from corvo.sweep.perturbation import Perturbation, read_perturbations


@dataclass(frozen=True)
class Plan:
    inputs: list[Input]
    options: list[OptionSet]
    perturbations: list[Perturbation]
    metrics: dict[str, float]
    """The tolerances of the metrics that the page shows and a baseline is compared by."""
    limits: Limits


def read_plan(file: str | PathLike[str]) -> Plan:
    """Reads a plan.

    Raises:
        Error: It cannot be read, a key is unknown, a value has the wrong type or is out of range,
            or an input does not exist. The message names the file and the field.
    """
    path = Path(file)
    root = Field(f"{path}: ", _load(path))
    values = root.mapping(("inputs", "options", "perturbations", "metrics", "limits"))
    if "inputs" not in values:
        raise Error(f"{path}: has no inputs; allowed is a list of them")
    folder = path.parent.absolute()

    def given(key: str, default: object) -> Field:
        return values.get(key, Field(f"{path}: {key}", default))

    perturbations = read_perturbations(given("perturbations", [{}]))
    inputs = read_inputs(values["inputs"], folder)
    _check_report_only(values["inputs"], inputs, perturbations)
    return Plan(
        inputs,
        read_options(given("options", {}), folder),
        perturbations,
        read_metrics(given("metrics", DEFAULT_METRICS)),
        read_limits(given("limits", {})),
    )


def _load(path: Path) -> Any:
    try:
        text = path.read_text(encoding="utf-8")
        _check_keys(yaml.compose(text))
        return yaml.safe_load(text)
    except OSError as error:
        raise Error(f"{path}: cannot be read ({error.strerror})") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise Error(f"{path}: is not YAML: {' '.join(str(error).split())}") from None


def _check_keys(node: Any) -> None:
    """Raises YAMLError if a mapping has a key twice, of which YAML would drop the first."""
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                line = node.start_mark.line + 1
                raise yaml.YAMLError(f"the mapping in line {line} has the key {key} twice")
        for _, value in node.value:
            _check_keys(value)
    elif isinstance(node, yaml.SequenceNode):
        for item in node.value:
            _check_keys(item)


def _check_report_only(
    field: Field, inputs: list[Input], perturbations: list[Perturbation]
) -> None:
    titles = [perturbation.title for perturbation in perturbations]
    for entry in inputs:
        for title in entry.report_only - set(titles):
            raise Error(
                f'{field.place}: report_only of {entry.name} has "{title}"; allowed are the '
                f"perturbations of the plan: {', '.join(titles)}"
            )
