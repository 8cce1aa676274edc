# SPDX-License-Identifier: MIT
"""Plots as plotly.js reads them."""

import base64
import json
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo.report.html import attribute, markup, paragraph

MAX_POINTS = 5000
"""Longer curves are thinned: more points cost time and are closer than a screen's pixels."""

_MAX_GAP = 3
"""A curve is interrupted between frames that are farther apart, as in the command's plots."""


@dataclass
class Figure:
    """A plot.

    Args:
        name: Its id in the page.
        title: What it shows.
        description: What a reader who cannot see it learns from it.
        notes: What the plot leaves out or cannot say; each shown below it.
    """

    name: str
    title: str
    description: str
    traces: list[dict[str, Any]] = field(default_factory=list)
    layout: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    size: str = "wide"  # A class of page.css.

    def html(self) -> str:
        notes = "".join(paragraph(note) for note in dict.fromkeys(self.notes))
        return (
            f'<figure aria-labelledby="{self.name}-title">\n'
            f'<div id="{self.name}" class="plot {self.size}" role="group" '
            f'aria-label="{attribute(self.title)}. {attribute(self.description)}"></div>\n'
            f'<figcaption><p id="{self.name}-title"><strong>{markup(self.title)}.</strong> '
            f"{markup(self.description)}</p>\n{notes}</figcaption>\n</figure>\n"
        )

    def json(self) -> dict[str, Any]:
        return {"id": self.name, "data": self.traces, "layout": self.layout}


def encode(figures: list[Figure]) -> str:
    """Returns figures as JSON that may stand in a script of a page."""
    text = json.dumps(
        [figure.json() for figure in figures],
        default=_encode_array,
        allow_nan=False,
        separators=(",", ":"),
    )
    return text.replace("<", "\\u003c")


def series(
    frames: NDArray[np.int64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[dict[str, Any], list[str]]:
    """Returns a curve over the frames where both are known, and notes on it."""
    is_known = np.isfinite(x) & np.isfinite(y)
    return _curve(frames[is_known], {"x": x[is_known], "y": y[is_known]}, *_extremes(y[is_known]))


def path(
    frames: NDArray[np.int64], positions: NDArray[np.float64]
) -> tuple[dict[str, Any], list[str]]:
    """Returns a curve through positions, shape (n, 3), and notes on it."""
    coordinates = dict(zip("xyz", positions.T))
    return _curve(frames, coordinates, *_every_nth(len(frames)))


def _curve(
    frames: NDArray[np.int64],
    coordinates: dict[str, NDArray[np.float64]],
    chosen: NDArray[np.int64],
    note: str,
) -> tuple[dict[str, Any], list[str]]:
    """Returns the chosen points, with NaN at gaps, and their frames as custom data."""
    pieces = np.cumsum(np.diff(frames, prepend=frames[:1]) > _MAX_GAP)
    gaps = np.flatnonzero(np.diff(pieces[chosen])) + 1
    curve: dict[str, Any] = {
        name: np.insert(values[chosen], gaps, np.nan).astype(np.float32)
        for name, values in coordinates.items()
    }
    curve["customdata"] = np.insert(frames[chosen], gaps, -1).astype(np.int32)
    return curve, [note] if note else []


def _every_nth(count: int) -> tuple[NDArray[np.int64], str]:
    """Returns the indices of at most MAX_POINTS of so many points, and a note on it."""
    step = math.ceil(count / MAX_POINTS)
    if step <= 1:
        return np.arange(count), ""
    chosen = np.unique(np.append(np.arange(0, count, step), count - 1))
    return chosen, f"Long paths are drawn through every {_ordinal(step)} pose."


def _extremes(values: NDArray[np.float64]) -> tuple[NDArray[np.int64], str]:
    """Returns the indices of at most MAX_POINTS values, with the extremes, and a note on it."""
    count = len(values)
    step = 2 * math.ceil(count / MAX_POINTS)
    if step <= 2:
        return np.arange(count), ""
    starts = range(0, count, step)
    picks = (np.argmin, np.argmax)
    chosen = [i + int(pick(values[i : i + step])) for i in starts for pick in picks]
    note = f"Of every {step} frames of long runs, the least and the greatest value are drawn."
    return np.unique(np.array([0, *chosen, count - 1])), note


def _ordinal(number: int) -> str:
    endings = {1: "st", 2: "nd", 3: "rd"}
    teens = 10 < number % 100 < 14
    return f"{number}{'th' if teens else endings.get(number % 10, 'th')}"


def _encode_array(value: Any) -> dict[str, str]:
    """Returns an array as plotly.js decodes it."""
    if not isinstance(value, np.ndarray):
        raise TypeError(f"{type(value)} in a plot")
    names = {"float32": "f4", "float64": "f8", "int32": "i4"}
    data = base64.b64encode(value.tobytes()).decode()
    return {"dtype": names[value.dtype.name], "bdata": data}
