# SPDX-License-Identifier: MIT
"""Plots of trajectories: from above and in three dimensions."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo.report import colors
from corvo.report.figure import Figure, path
from corvo.report.html import number
from corvo.report.run import Run, in_units

_NO_COMMON_SCALE = (
    "Without ground truth, each run and each segment has a position, direction and scale of its "
    "own: compare shapes, not sizes."
)


def trajectory_figures(runs: Sequence[Run]) -> list[Figure]:
    """Returns no plots if no run has poses."""
    return [draw(alike) for alike in in_units(runs) for draw in (_from_above, _in_3d)]


def _from_above(runs: Sequence[Run]) -> Figure:
    unit = runs[0].unit
    figure = Figure(f"above-{unit}", "Trajectories from above", _describe(runs), size="square")
    figure.traces = [_flat(trace) for trace in _truths(runs)]
    for run in runs:
        for trace, notes in _estimates(run):
            figure.traces.append(_flat(trace))
            figure.notes += notes
    figure.traces += [_flat(trace) for trace in _marks(runs)]
    figure.notes += _scale_notes(runs)
    figure.layout = {
        "xaxis": {"title": {"text": f"right [{unit}]"}},
        "yaxis": {"title": {"text": f"forward [{unit}]"}, "scaleanchor": "x"},
    }
    return figure


def _in_3d(runs: Sequence[Run]) -> Figure:
    unit = runs[0].unit
    figure = Figure(
        f"space-{unit}",
        "Trajectories in three dimensions",
        "The same paths with their heights. Drag to turn the view, scroll or pinch to zoom.",
        size="square",
    )
    figure.traces = [_spatial(trace) for trace in _truths(runs)]
    figure.traces += [_spatial(trace) for run in runs for trace, _ in _estimates(run)]
    figure.layout = {"scene": _scene(np.concatenate([run.positions for run in runs]), unit)}
    return figure


def _scene(positions: NDArray[np.float64], unit: str) -> dict[str, Any]:
    """Returns a scene with equal scales on all axes, seen from behind and above."""
    least, most = np.nanmin(positions, axis=0), np.nanmax(positions, axis=0)
    longest = float(max(most - least)) or 1.0
    margin = 0.05 * longest
    scene: dict[str, Any] = {
        "aspectmode": "manual",
        "aspectratio": {},
        "camera": {"eye": {"x": -0.4, "y": -1.5, "z": 1.1}, "center": {"x": 0, "y": 0, "z": -0.15}},
    }
    for axis, title, low, high in zip("xyz", ("right", "forward", "up"), least, most):
        length = float(high - low) + 2 * margin
        scene["aspectratio"][axis] = 1.35 * length / longest
        scene[f"{axis}axis"] = {
            "title": {"text": f"{title} [{unit}]"},
            "range": [float(low) - margin, float(high) + margin],
            "nticks": max(2, round(8 * length / longest)),
        }
    return scene


def _flat(trace: dict[str, Any]) -> dict[str, Any]:
    return {"type": "scatter", **{name: trace[name] for name in trace if name != "z"}}


def _spatial(trace: dict[str, Any]) -> dict[str, Any]:
    width = 2 if trace["line"]["color"] == colors.TRUTH else 4
    return {**trace, "type": "scatter3d", "line": {**trace["line"], "width": width}}


def _truths(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Returns each ground truth once."""
    traces: dict[bytes, dict[str, Any]] = {}
    for run in runs:
        if run.true_path is None or run.true_path.tobytes() in traces:
            continue
        curve, _ = path(np.arange(len(run.true_path)), run.true_path)
        del curve["customdata"]
        traces[run.true_path.tobytes()] = {
            **curve,
            "mode": "lines",
            "line": {"color": colors.TRUTH, "width": 5},
            "name": "ground truth" if not traces else f"ground truth of {run.name}",
            "hoverinfo": "name",
        }
    return list(traces.values())


def _estimates(run: Run) -> list[tuple[dict[str, Any], list[str]]]:
    """Returns a curve for each segment of a run, and notes on it."""
    estimates = []
    for variant, segment in enumerate(run.posed_segments):
        style = colors.line(variant) if run.is_alone else colors.line(run.index, variant)
        estimates.append(_estimate(run, segment, _segment_name(run, segment), style))
    return estimates


def _estimate(
    run: Run, segment: int, name: str, style: dict[str, object]
) -> tuple[dict[str, Any], list[str]]:
    chosen = np.flatnonzero(run.frames.is_posed & (run.frames.segments == segment))
    curve, notes = path(chosen, run.positions[chosen])
    trace = {
        **curve,
        "mode": "lines" if len(chosen) > 1 else "markers",
        "line": style,
        "marker": {"color": style["color"]},
        "name": name,
        "hovertemplate": "frame %{customdata}: %{x:.4g}, %{y:.4g}",
    }
    return trace, notes


def _marks(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Returns marks where the paths begin, and at frames whose scale is uncertain."""
    starts = [run.positions[np.flatnonzero(run.frames.is_posed)[0]] for run in runs]
    doubtful = [run.positions[_frames_of(run, "scale_uncertain")] for run in runs]
    marks = [_mark(np.array(starts), "start", "circle-open", "#808080")]
    positions = np.concatenate(doubtful)
    if len(positions):
        marks.append(_mark(positions, "scale uncertain", "x-thin-open", colors.DOUBT))
    return marks


def _frames_of(run: Run, kind: str) -> list[int]:
    spans = [span for span in run.spans if span.kind == kind]
    return [i for span in spans for i in range(span.first, span.last + 1)]


def _mark(
    positions: NDArray[np.float64], name: str, symbol: str, color: str
) -> dict[str, Any]:
    x, y = positions[:, 0].astype(np.float32), positions[:, 1].astype(np.float32)
    marker = {"symbol": symbol, "size": 10, "color": color, "line": {"width": 2}}
    return {
        "x": x, "y": y, "mode": "markers", "marker": marker, "name": name, "hoverinfo": "name"
    }  # fmt: skip


def _segment_name(run: Run, segment: int) -> str:
    if len(run.posed_segments) == 1:
        return "estimate" if run.is_alone else run.name
    return f"segment {segment}" if run.is_alone else f"{run.name}, segment {segment}"


def _scale_notes(runs: Sequence[Run]) -> list[str]:
    parts = sum(len(run.posed_segments) for run in runs)
    is_compared = all(run.comparison for run in runs)
    if not is_compared and parts > 1:
        return [_NO_COMMON_SCALE]
    if any(len(run.posed_segments) > 1 for run in runs):
        return ["One similarity aligns all segments of a run with the ground truth."]
    return []


def _describe(runs: Sequence[Run]) -> str:
    texts = []
    for run in runs:
        text = f"{run.name}: a path of {number(run.path_length)} {run.unit}"
        if len(run.posed_segments) > 1:
            text += f" in {len(run.posed_segments)} segments"
        if run.comparison:
            ate = run.comparison.measures["ate"]["rmse"]
            text += f", aligned with the ground truth (Sim3), ATE {number(ate)} m"
        texts.append(text)
    return "; ".join(texts) + "."
