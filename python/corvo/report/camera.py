# SPDX-License-Identifier: MIT
"""The estimated camera of a run beside the given one."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from corvo.report import colors
from corvo.report.figure import Figure
from corvo.report.html import number
from corvo.report.run import Run


class Parameter(NamedTuple):
    name: str
    given: float
    value: float
    sigma: float
    share_from_data: float

    @property
    def change(self) -> float:
        """The difference from the given value, in standard deviations of the estimate."""
        return (self.value - self.given) / self.sigma if self.sigma > 0 else 0.0


def parameters_of(run: Run) -> list[Parameter]:
    """Returns no parameters if the camera was taken as given, or if no frame has a pose."""
    if not run.posed_segments:
        return []
    calibration = run.summary.get("calibration") or {}
    return [
        Parameter(name, *(float(e[key]) for key in ("given", "value", "sigma", "share_from_data")))
        for name, e in calibration.items()
        if isinstance(e, dict)
    ]


def camera_figure(runs: Sequence[Run]) -> Figure | None:
    """Returns None if no camera was estimated."""
    estimated = [(run, parameters) for run in runs if (parameters := parameters_of(run))]
    if not estimated:
        return None
    figure = Figure(
        "camera-change",
        "Estimated camera against the given one",
        "Difference from the given value in standard deviations of the estimate, with bars of one. "
        + " ".join(_describe(run, parameters) for run, parameters in estimated),
    )
    figure.traces = [_dots(run, parameters) for run, parameters in estimated]
    names = dict.fromkeys(p.name for _, parameters in estimated for p in parameters)
    figure.layout = {
        "xaxis": {"type": "category", "categoryarray": list(names), "categoryorder": "array"},
        "yaxis": {"title": {"text": "(estimate − given) / σ"}, "zeroline": True},
        "scattermode": "group",
        "showlegend": len(runs) > 1,
    }
    return figure


def _dots(run: Run, parameters: list[Parameter]) -> dict[str, Any]:
    color = colors.line(run.index)["color"]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": run.name,
        "x": [parameter.name for parameter in parameters],
        "y": np.array([parameter.change for parameter in parameters], np.float64),
        "error_y": {"type": "constant", "value": 1, "thickness": 2, "width": 6},
        "marker": {"color": color, "size": 9},
        "text": [
            f"{number(p.value, 5)} ± {number(p.sigma, 2)}, given {number(p.given, 5)}"
            for p in parameters
        ],
        "hovertemplate": "%{x}: %{text}",
    }


def _describe(run: Run, parameters: list[Parameter]) -> str:
    most = max(parameters, key=lambda parameter: abs(parameter.change))
    return f"{run.name}: {most.name} differs most, by {most.change:+.1f}."
