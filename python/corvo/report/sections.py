# SPDX-License-Identifier: MIT
"""The sections of a page."""

from collections.abc import Sequence

from corvo.report.camera import camera_figure, camera_history_figure, parameters_of
from corvo.report.doubts import doubts_of
from corvo.report.error_figures import error_figures
from corvo.report.figure import Figure
from corvo.report.frame_figures import masked_figure, timeline
from corvo.report.html import bullets, number, paragraph, picture, table
from corvo.report.options_tables import options_tables
from corvo.report.run import Run
from corvo.report.section import Section
from corvo.report.spans_table import spans_table, states_list
from corvo.report.summary_table import summary_table
from corvo.report.timing import STAGES, percentiles
from corvo.report.timing_figure import timing_figure
from corvo.report.trajectory_figures import trajectory_figures


def make_sections(runs: Sequence[Run]) -> list[Section]:
    masked = masked_figure(runs)
    sections = [
        Section("summary", "Summary", [summary_table(runs)]),
        Section("doubts", "What not to trust", [*map(_doubts, runs)]),
        Section("trajectories", "Trajectories", _or_none(trajectory_figures(runs))),
        Section("errors", "Errors and uncertainty", _or_none(error_figures(runs))),
        Section("account", "Frames", [timeline(runs), *map(spans_table, runs), states_list(runs)]),
        Section("camera", "Camera", _camera(runs)),
        Section("timing", "Timing", _timing(runs)),
        Section("options", "Options", [options_tables(runs)]),
    ]
    if masked:
        text = paragraph(
            "Texture that stays in place while the scene moves, such as a bonnet, is masked."
        )
        sections.insert(5, Section("masked", "Masked areas", [text, masked, *_masks(runs)]))
    return sections


def _masks(runs: Sequence[Run]) -> list[str]:
    return [
        picture(run.mask_png, f"{run.name}: black is what was masked in the last image.")
        for run in runs
        if run.mask_png
    ]


def _or_none(figures: Sequence[Figure]) -> list[str | Figure]:
    return [*figures] or [paragraph("No frame has a pose.")]


def _doubts(run: Run) -> str:
    doubts, warnings = doubts_of(run), run.summary["warnings"]
    html = ""
    if doubts:
        html += table(f"Doubtful frames of {run.name}", ["Frames", "Why", "What to do"], doubts)
    if warnings:
        html += paragraph(f"Warnings of {run.name}:") + bullets(warnings)
    return html or paragraph(f"{run.name} has no doubts of its own.")


def _camera(runs: Sequence[Run]) -> list[str | Figure]:
    figure = camera_figure(runs)
    if figure is None:
        return [paragraph("The camera was taken as given.")]
    histories = [history for run in runs if (history := camera_history_figure(run))]
    return [figure, *histories, *map(_camera_table, runs)]


def _camera_table(run: Run) -> str:
    parameters = parameters_of(run)
    if not parameters:
        return paragraph(f"{run.name}: the camera was taken as given.")
    rows = [
        (p.name, number(p.given, 5), number(p.value, 5), f"± {number(p.sigma, 2)}",
         f"{p.share_from_data:.0%}")
        for p in parameters
    ]  # fmt: skip
    header = ["Parameter", "Given", "Estimate", "Standard deviation", "From the images"]
    return table(f"Camera of {run.name}", header, rows)


def _timing(runs: Sequence[Run]) -> list[str | Figure]:
    figure = timing_figure(runs)
    if figure is None:
        return [paragraph("No image was processed.")]
    return [figure, *map(_timing_table, runs)]


def _timing_table(run: Run) -> str:
    columns = {text: run.timing.columns[name] for name, text in STAGES.items()}
    if run.timing.latency_ms is not None:
        columns["latency, from when the image was due"] = run.timing.latency_ms
    rows = [
        (text, *(f"{value:.1f}" for value in percentiles(values)))
        for text, values in columns.items()
        if len(values)
    ]
    header = ["Milliseconds a frame", "median", "90%", "99%", "most"]
    machine = run.timing.environment
    on = paragraph(f"Processor: {machine['cpu']}; option `--threads`: {machine['threads']}.")
    return table(f"Timing of {run.name}", header, rows) + on
