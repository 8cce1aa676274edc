# SPDX-License-Identifier: MIT
"""Plots of what became of the frames."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from corvo.report import colors
from corvo.report.figure import Figure, series
from corvo.report.frames import KINDS, Span
from corvo.report.html import frame_range
from corvo.report.run import Run

MAX_SPANS = 2000
"""More bars than this cost time and are narrower than a screen's pixels."""


def timeline(runs: Sequence[Run]) -> Figure:
    figure = Figure("frames", "Frames by state", " ".join(_describe(run) for run in runs))
    shown = [(run, span) for run in runs for span in _longest(run.spans, figure.notes)]
    for kind in KINDS:
        spans = [(run, span) for run, span in shown if span.kind == kind]
        if spans:
            figure.traces.append(_bars(kind, spans))
    figure.size = "strip" if len(runs) <= 2 else "wide"
    figure.layout = {
        "barmode": "overlay",
        "bargap": 0.3,
        "showlegend": True,
        "xaxis": {"title": {"text": "frame"}},
        "yaxis": {
            "type": "category",
            "categoryorder": "array",
            "categoryarray": [run.name for run in reversed(runs)],
            "showticklabels": len(runs) > 1,
            "automargin": True,
        },
    }
    return figure


def masked_figure(runs: Sequence[Run]) -> Figure | None:
    """Returns None if nothing was masked because it moves with the camera."""
    masked = [run for run in runs if run.frames.masked.any()]
    if not masked:
        return None
    figure = Figure("masked-share", "Masked share of the images", "")
    texts = []
    for run in runs:
        share = 100 * run.frames.masked
        numbers = np.arange(len(share))
        curve, notes = series(numbers, numbers.astype(float), share)
        figure.notes += notes
        trace = {**curve, "type": "scatter", "mode": "lines", "line": colors.line(run.index)}
        trace |= {"name": run.name, "hovertemplate": "frame %{customdata}: %{y:.3g}%"}
        figure.traces.append(trace)
        if len(share):
            mean, most = share.mean(), share.max()
            texts.append(f"{run.name}: {mean:.1f}% in the mean, at most {most:.1f}%.")
    figure.description = " ".join(texts)
    figure.layout = {
        "xaxis": {"title": {"text": "frame"}},
        "yaxis": {"title": {"text": "share of the image [%]"}, "rangemode": "tozero"},
    }
    return figure


def _longest(spans: list[Span], notes: list[str]) -> list[Span]:
    if len(spans) <= MAX_SPANS:
        return spans
    notes.append(f"Only the {MAX_SPANS} longest spans are drawn.")
    return sorted(spans, key=lambda span: -span.num_frames)[:MAX_SPANS]


def _bars(kind: str, spans: list[tuple[Run, Span]]) -> dict[str, Any]:
    color, pattern = colors.KINDS[kind]
    return {
        "type": "bar",
        "orientation": "h",
        "name": KINDS[kind],
        "y": [run.name for run, _ in spans],
        "base": np.array([span.first - 0.5 for _, span in spans], np.float32),
        "x": np.array([span.num_frames for _, span in spans], np.int32),
        "text": [f"{frame_range(s.first, s.last)}: {s.state}, {s.reason}" for _, s in spans],
        "textposition": "none",
        "hovertemplate": "frames %{text}",
        "marker": {
            "color": color,
            "line": {"width": 0},
            "pattern": {"shape": pattern, "fillmode": "overlay", "size": 6},
        },
    }


def _describe(run: Run) -> str:
    counts: Counter[str] = Counter()
    for span in run.spans:
        counts[span.kind] += span.num_frames
    parts = [f"{counts[kind]} {text}" for kind, text in KINDS.items() if counts[kind]]
    return f"{run.name}, {len(run.frames)} frames: {', '.join(parts) or 'none'}."
