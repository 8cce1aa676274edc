# SPDX-License-Identifier: MIT
"""The estimated camera of a run beside the given one."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from corvo.report import colors
from corvo.report.camera_history import CameraHistory
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


def camera_history_figure(run: Run) -> Figure | None:
    """Returns None if no parameter of the camera changed."""
    history = run.camera_history
    changed = history.changed if history else []
    if not history or not changed:
        return None
    kept = [name for name in history.values if name not in changed]
    figure = Figure(
        f"camera-history-{run.index}",
        f"Camera of {run.name} over time",
        "Difference from the given value in standard deviations of the given one, with bars of "
        f"the estimate's own. The camera was estimated {len(history.frames) - 1} times.",
    )
    figure.traces = [_steps(run, history, name, i) for i, name in enumerate(changed)]
    if kept:
        figure.notes = [f"Without evidence against it, the given value was kept: {', '.join(kept)}."]
    figure.layout = {
        "xaxis": {"title": {"text": "frame"}},
        "yaxis": {"title": {"text": "(estimate − given) / σ of the given"}, "zeroline": True},
        "showlegend": True,
    }
    return figure


def _steps(run: Run, history: CameraHistory, name: str, variant: int) -> dict[str, Any]:
    """Returns the curve of a parameter, whose last estimate holds until the last frame."""
    held = [*range(len(history.frames)), -1]
    values, sigmas = history.values[name][held], history.sigmas[name][held]
    bars = sigmas / sigmas[0]
    bars[-1] = 0
    line = colors.line(variant)
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": name,
        "x": np.append(history.frames, len(run.frames) - 1).astype(np.int32),
        "y": (values - values[0]) / sigmas[0],
        "error_y": {"type": "data", "array": bars, "thickness": 1},
        "line": {**line, "shape": "hv"},
        "marker": {"color": line["color"], "size": 5},
        "text": [f"{number(v, 5)} ± {number(s, 2)}" for v, s in zip(values, sigmas)],
        "hovertemplate": "frame %{x}: %{text}",
    }


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
