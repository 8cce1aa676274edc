# SPDX-License-Identifier: MIT
"""What of a run should not be trusted, and why."""

from typing import Any, NamedTuple

from corvo.report.html import frame_range
from corvo.report.reasons import REASONS
from corvo.report.run import Run


class Doubt(NamedTuple):
    frames: str
    why: str
    remedy: str


def doubts_of(run: Run) -> list[Doubt]:
    """Returns the doubts about frames; those about the whole run come first."""
    about_all = [*_about_end(run), *_about_poses(run)]
    return [*about_all, *_about_segments(run), *_about_scale(run), *_about_drift(run)]


def _about_end(run: Run) -> list[Doubt]:
    if run.summary["complete"]:
        return []
    expected = run.summary["frames_expected"]
    of_all = f" of {expected}" if expected is not None else ""
    why = f"The run ended early, after {len(run.frames)}{of_all} frames: {run.summary['ended_by']}."
    return [Doubt("all", why, "Run it to its end.")]


def _about_poses(run: Run) -> list[Doubt]:
    if run.posed_segments:
        return []
    return [Doubt("all", "No frame has a pose.", "See the reasons of the frames below.")]


def _about_segments(run: Run) -> list[Doubt]:
    return [
        Doubt(
            frame_range(segment["first_frame"], segment["last_frame"]),
            f"Segment {segment['index']}: {_scale_text(segment['scale'])}",
            "Analyze segments one by one if their relative scale matters.",
        )
        for segment in run.summary["segments"][1:]
        if segment["scale"]["from"] in ("arbitrary", "median_speed")
    ]


def _scale_text(scale: dict[str, Any]) -> str:
    if scale["from"] == "arbitrary":
        return "its scale is related to no other segment."
    return (
        "its scale relative to the segment before is guessed from the median speed before the "
        f"loss, within a factor of {scale['factor']:.2g}."
    )


def _about_scale(run: Run) -> list[Doubt]:
    reason = REASONS["scale_uncertain"]
    ranges = run.summary["scale_uncertain"]
    return [Doubt(frame_range(*frames), reason.meaning, reason.remedy) for frames in ranges]


def _about_drift(run: Run) -> list[Doubt]:
    ranges = run.summary["least_certain"]
    if not ranges:
        return []
    why = "The tenth of the frames whose positions are least certain, by the covariances."
    frames = ", ".join(frame_range(*frames) for frames in ranges)
    return [Doubt(frames, why, "Trust these least, even where nothing is wrong.")]
