# SPDX-License-Identifier: MIT
"""The plot of what the frames cost."""

from collections.abc import Sequence

import numpy as np

from corvo.report import colors
from corvo.report.figure import Figure, series
from corvo.report.run import Run


def timing_figure(runs: Sequence[Run]) -> Figure | None:
    """Returns None if no frame was processed."""
    if all(run.timing.median_ms is None for run in runs):
        return None
    figure = Figure("time", "Processing time of each frame", "")
    texts = []
    for run in runs:
        _add(figure, run)
        total_ms = run.timing.columns["total_ms"]
        if len(total_ms):
            texts.append(
                f"{run.name}: median {np.median(total_ms):.1f} ms, "
                f"at most {total_ms.max():.1f} ms at frame {total_ms.argmax()}."
            )
    figure.description = " ".join(texts)
    figure.layout = {
        "xaxis": {"title": {"text": "frame"}},
        "yaxis": {"title": {"text": "time [ms]"}, "rangemode": "tozero"},
        "showlegend": len(figure.traces) > 1,
    }
    return figure


def _add(figure: Figure, run: Run) -> None:
    curves = {run.name: run.timing.columns["total_ms"]}
    if run.timing.latency_ms is not None:
        curves[f"{run.name}, latency"] = run.timing.latency_ms
    for variant, (name, values) in enumerate(curves.items()):
        numbers = np.arange(len(values))
        curve, notes = series(numbers, numbers.astype(float), values)
        figure.notes += notes
        style = {**colors.line(run.index, variant), "width": 1.2}
        trace = {**curve, "type": "scatter", "mode": "lines", "line": style, "name": name}
        figure.traces.append(trace | {"hovertemplate": "frame %{customdata}: %{y:.1f} ms"})
