# SPDX-License-Identifier: MIT
"""Plots of errors along the path, and of the standard deviations that are stated for them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo.report import colors
from corvo.report.figure import Figure, series
from corvo.report.html import number
from corvo.report.run import Run, in_units

_MAX_BANDS = 3
"""The bands of further runs are hidden until a reader asks for them in the legend."""


def error_figures(runs: Sequence[Run]) -> list[Figure]:
    """Returns no plots if no run has poses."""
    return [draw(alike) for alike in in_units(runs) for draw in (_along_path, _relative)]


def _along_path(runs: Sequence[Run]) -> Figure:
    has_truth = any(run.comparison for run in runs)
    figure = Figure(
        f"error-{runs[0].unit}",
        "Error along the path" if has_truth else "Expected error along the path",
        " ".join(_describe(run) for run in runs),
    )
    for run in runs:
        _add_band(figure, run, is_hidden=run.index >= _MAX_BANDS)
    for run in runs:
        if run.comparison:
            _add_error(figure, run, run.comparison.measures["ate"]["rmse"])
    unit = runs[0].unit
    figure.layout = {
        "xaxis": {"title": {"text": f"length of the path [{unit}]"}},
        "yaxis": {"title": {"text": f"position [{unit}]"}, "rangemode": "tozero"},
    }
    if has_truth:
        figure.notes.append("The dashed line is the ATE.")
    figure.notes.append(
        "The area reaches to one standard deviation of the position after the alignment, the thin "
        "line to two: `drift_sigma`, which the covariances of the pose graph let expect. What they "
        "do not contain (wrong matches, moving objects, a lens unlike its model) comes on top."
    )
    return figure


def _add_band(figure: Figure, run: Run, is_hidden: bool) -> None:
    for factor, fill in ((1, "tozeroy"), (2, "none")):
        curve, notes = _over_path(run, factor * run.drift_sigma)
        figure.notes += notes
        line: dict[str, Any] = {"color": colors.faint(run.index, 0.8), "dash": "dot"}
        line["width"] = 0 if factor == 1 else 1.5
        name = "expected, 1 σ and 2 σ"
        name = name if run.is_alone else f"{run.name}, {name}"
        trace = {**curve, "type": "scatter", "mode": "lines", "line": line, "name": name}
        trace |= {"fill": fill, "fillcolor": colors.faint(run.index, 0.3)}
        trace |= {"legendgroup": f"band {run.index}", "showlegend": factor == 1}
        trace["hovertemplate"] = f"frame %{{customdata}}: {factor} σ = %{{y:.3g}}"
        if is_hidden:
            trace["visible"] = "legendonly"
        figure.traces.append(trace)


def _add_error(figure: Figure, run: Run, ate: float) -> None:
    curve, notes = _over_path(run, run.errors)
    figure.notes += notes
    style = colors.line(run.index)
    name = f"{'error' if run.is_alone else run.name}, ATE {number(ate)} m"
    trace = {**curve, "type": "scatter", "mode": "lines", "line": style, "name": name}
    trace["legendgroup"] = f"error {run.index}"
    trace["hovertemplate"] = "frame %{customdata}: %{y:.3g} m"
    figure.traces.append(trace)
    figure.traces.append(
        {
            "type": "scatter",
            "x": np.array([0, run.path_length], np.float32),
            "y": np.array([ate, ate], np.float32),
            "mode": "lines",
            "line": {"color": style["color"], "width": 1, "dash": "dash"},
            "name": name,
            "legendgroup": f"error {run.index}",
            "showlegend": False,
            "hoverinfo": "skip",
        }
    )


def _over_path(run: Run, values: NDArray[np.float64]) -> tuple[dict[str, Any], list[str]]:
    return series(np.arange(len(run.frames)), run.distances, values)


def _describe(run: Run) -> str:
    sigma = number(_root_mean_square(run.drift_sigma))
    expected = f"an error of {sigma} {run.unit} is expected at least"
    if run.comparison is None:
        return f"{run.name}: {expected} (root mean square)."
    ate = run.comparison.measures["ate"]
    worst = int(np.nanargmax(run.errors))
    share = np.nanmean(run.errors <= run.drift_sigma)
    return (
        f"{run.name}: root mean square (ATE) {number(ate['rmse'])} m, greatest "
        f"{number(ate['max'])} m at frame {worst}; {expected}; {share:.0%} of the poses are within "
        "one standard deviation."
    )


def _relative(runs: Sequence[Run]) -> Figure:
    figure = Figure(
        f"relative-{runs[0].unit}",
        "Stated standard deviation of each pose, relative to its reference keyframe",
        " ".join(_describe_relative(run) for run in runs),
        size="tall",
    )
    for run in runs:
        _add_relative(figure, run)
    unit = runs[0].unit
    figure.layout = {
        "grid": {"rows": 2, "columns": 1, "roworder": "top to bottom"},
        "xaxis": {"anchor": "y2", "title": {"text": "frame"}},
        "yaxis": _logarithmic(f"position [{unit}]", 0.54, 1),
        "yaxis2": _logarithmic("rotation [°]", 0, 0.46),
        "showlegend": len(runs) > 1,
    }
    figure.notes.append(
        "From `relative_poses.csv`: the root of the sum of the variances along the three axes, as "
        "they were when the frame was located."
    )
    return figure


def _logarithmic(title: str, bottom: float, top: float) -> dict[str, Any]:
    ticks = {"type": "log", "exponentformat": "power"}
    return {"title": {"text": title}, "domain": [bottom, top], **ticks}


def _add_relative(figure: Figure, run: Run) -> None:
    numbers = np.arange(len(run.frames))
    values = {"y": run.relative_sigma, "y2": run.relative_sigma_deg}
    for axis, sigma in values.items():
        positive = np.where(sigma > 0, sigma, np.nan)  # The axis is logarithmic.
        curve, notes = series(numbers, numbers.astype(float), positive)
        figure.notes += notes
        style = {**colors.line(run.index), "width": 1.5}
        trace = {**curve, "type": "scatter", "mode": "lines", "line": style, "xaxis": "x"}
        trace |= {"yaxis": axis, "name": "estimate" if run.is_alone else run.name}
        trace |= {"legendgroup": f"run {run.index}", "showlegend": axis == "y"}
        trace["hovertemplate"] = "frame %{customdata}: %{y:.3g}"
        figure.traces.append(trace)


def _describe_relative(run: Run) -> str:
    if not np.isfinite(run.relative_sigma).any():
        return f"{run.name}: none."
    return (
        f"{run.name}: median {number(float(np.nanmedian(run.relative_sigma)))} {run.unit} and "
        f"{number(float(np.nanmedian(run.relative_sigma_deg)))}°."
    )


def _root_mean_square(values: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.nanmean(values**2)))
