# SPDX-License-Identifier: MIT
"""The frames of a run as arrays, and the spans of frames with the same outcome."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from corvo.result import Result

_MISSING_IMAGE = ("unreadable_image", "wrong_size")

KINDS = {
    "tracked": "posed",
    "scale_uncertain": "posed, scale uncertain",
    "rotation_only": "rotation only",
    "initializing": "initializing",
    "lost": "lost",
    "missing": "without a usable image",
}
"""What became of a frame, by its kind."""


@dataclass(frozen=True)
class Frames:
    """frames.csv; all have the shape (n,)."""

    times_s: NDArray[np.float64]  # Since the first frame.
    states: list[str]
    reasons: list[str]
    segments: NDArray[np.int64]
    is_posed: NDArray[np.bool_]
    masked: NDArray[np.float64]  # Share of the image, 0 to 1.
    drift_sigma: NDArray[np.float64]  # NaN without a pose.

    def __len__(self) -> int:
        return len(self.states)


@dataclass(frozen=True)
class Span:
    """Consecutive frames, both ends included, of the same state, reason and segment."""

    first: int
    last: int
    kind: str
    state: str
    reason: str
    segment: int
    num_repeated: int  # Posed frames whose image repeats an earlier one.

    @property
    def num_frames(self) -> int:
        return self.last - self.first + 1

    @property
    def is_posed(self) -> bool:
        return self.kind in ("tracked", "scale_uncertain")


def read_frames(result: Result) -> Frames:
    rows = result.rows
    is_posed = np.array([row["posed"] == "1" for row in rows], bool)
    times_s = _column(rows, "timestamp")
    return Frames(
        times_s=times_s - times_s[:1],
        states=[row["state"] for row in rows],
        reasons=[row["reason"] for row in rows],
        segments=np.array([int(row["segment"]) for row in rows], np.int64),
        is_posed=is_posed,
        masked=_column(rows, "masked"),
        drift_sigma=np.where(is_posed, _column(rows, "drift_sigma"), np.nan),
    )


def find_spans(frames: Frames) -> list[Span]:
    """Returns the spans in the order of the frames. Repeated images do not interrupt a span."""
    outcomes = [_outcome(frames, i) for i in range(len(frames))]
    starts = [i for i in range(len(outcomes)) if i == 0 or outcomes[i] != outcomes[i - 1]]
    ends = [*starts[1:], len(outcomes)]
    return [_span(frames, first, end - 1) for first, end in zip(starts, ends)]


def _span(frames: Frames, first: int, last: int) -> Span:
    kind, state, reason, segment = _outcome(frames, first)
    reasons = frames.reasons[first : last + 1]
    num_repeated = reasons.count("repeated_image") if frames.is_posed[first] else 0
    return Span(first, last, kind, state, reason, segment, num_repeated)


def _outcome(frames: Frames, i: int) -> tuple[str, str, str, int]:
    state, reason, segment = frames.states[i], frames.reasons[i], int(frames.segments[i])
    if not frames.is_posed[i]:
        return _unposed_kind(state, reason), state, reason, segment
    if reason == "repeated_image":
        reason = "none"
    kind = "scale_uncertain" if reason == "scale_uncertain" else "tracked"
    return kind, state, reason, segment


def _unposed_kind(state: str, reason: str) -> str:
    if reason in _MISSING_IMAGE:
        return "missing"
    return state if state in KINDS else "lost"


def _column(rows: list[dict[str, str]], name: str) -> NDArray[np.float64]:
    return np.array([float(row[name]) for row in rows], np.float64)
