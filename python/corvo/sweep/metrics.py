# SPDX-License-Identifier: MIT
"""What is measured of a run, and how much worse it may become."""

from dataclasses import dataclass
from typing import Literal

from corvo._corvo import Error
from corvo.sweep.fields import Field


@dataclass(frozen=True)
class Metric:
    name: str
    """Its column in rows.parquet."""
    title: str
    better: Literal["less", "more"]
    unit: str = ""

    @property
    def is_relative(self) -> bool:
        """Whether changes are relative: those of errors are, not those of shares and counts."""
        return bool(self.unit)

    @property
    def worst(self) -> float:
        """The value that stands for unknown ones, such as the error of a run without poses."""
        return float("inf") if self.better == "less" else 0.0


METRICS = {
    metric.name: metric
    for metric in (
        Metric("ate", "ATE", "less", "m"),
        Metric("ate_percent", "ATE, share of the path", "less", "%"),
        Metric("live_ate", "ATE of the live poses", "less", "m"),
        Metric("rpe", "RPE from frame to frame", "less", "m"),
        Metric("rpe_deg", "RPE from frame to frame", "less", "°"),
        Metric("rotation_deg", "Error of the rotation over 1 s", "less", "°"),
        Metric("t_rel_percent", "KITTI drift", "less", "%"),
        Metric("r_rel_deg_per_100m", "KITTI drift", "less", "°/100 m"),
        Metric("posed_share", "Frames posed", "more"),
        Metric("rotation_share", "Frames with a rotation", "more"),
        Metric("coverage", "Truth covered", "more"),
        Metric("segments", "Segments", "less"),
        Metric("losses", "Losses", "less"),
    )
}

DEFAULT_METRICS = {"ate": 0.05, "posed_share": 0.01, "segments": 0.0}
"""The metrics of a plan that names none, with their tolerances."""

DEFAULT_TOLERANCE = 0.05


def read_metrics(field: Field) -> dict[str, float]:
    """Returns the metrics that the page shows and a baseline is compared by, with tolerances.

    Raises:
        Error: A metric is unknown or a tolerance out of range.
    """
    if isinstance(field.value, list):
        return {_known(item): DEFAULT_TOLERANCE for item in field.items()}
    values = field.mapping(METRICS)
    if not values:
        raise field.error("a list or mapping that is not empty")
    return {name: value.number(0, 10) for name, value in values.items()}


def _known(item: Field) -> str:
    name = item.text()
    if name not in METRICS:
        raise Error(f"{item.place} is {name}; allowed are {', '.join(METRICS)}")
    return name
