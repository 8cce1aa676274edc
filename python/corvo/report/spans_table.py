# SPDX-License-Identifier: MIT
"""An account of the frames in plain words."""

from collections.abc import Sequence

from corvo.report.frames import Span
from corvo.report.html import bullets, frame_range, paragraph, table
from corvo.report.reasons import REASONS, STATES, Reason
from corvo.report.run import Run

MAX_ROWS = 200
"""The most spans in a table."""


def spans_table(run: Run) -> str:
    if not run.spans:
        return paragraph(f"{run.name}: no image was processed.")
    html = ""
    shown = sorted(run.spans, key=lambda span: -span.num_frames)[:MAX_ROWS]
    shown.sort(key=lambda span: span.first)
    if len(shown) < len(run.spans):
        left_out = len(run.spans) - len(shown)
        html += paragraph(
            f"The {MAX_ROWS} longest spans; {left_out} shorter ones are in `frames.csv`."
        )
    header = ["Frames", "State", "In plain words", "What to change", "Reason", "Time [s]", "Number"]
    return html + table(f"Spans of {run.name}", header, [_span_row(run, span) for span in shown])


def _span_row(run: Run, span: Span) -> list[object]:
    reason = REASONS.get(span.reason, Reason("", ""))
    first_s, last_s = (run.frames.times_s[i] for i in (span.first, span.last))
    text = reason.meaning
    if span.num_repeated:
        text += f" {span.num_repeated} of the images repeat an earlier one (`repeated_image`)."
    return [
        frame_range(span.first, span.last),
        span.state,
        text,
        reason.remedy,
        f"`{span.reason}`",
        f"{first_s:.2f}\N{EN DASH}{last_s:.2f}",
        span.num_frames,
    ]


def states_list(runs: Sequence[Run]) -> str:
    """Returns what the states of the spans mean."""
    states = dict.fromkeys(span.state for run in runs for span in run.spans)
    return bullets(f"`{state}`: {STATES[state]}" for state in states if state in STATES)
