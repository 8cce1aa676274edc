# SPDX-License-Identifier: MIT
"""The main figures of runs, side by side."""

from collections.abc import Callable, Sequence

from corvo.report.html import breakable, number, table
from corvo.report.run import Run


def summary_table(runs: Sequence[Run]) -> str:
    """Returns a row for each figure that any of the runs has."""
    figures = {name: [measure(run) for run in runs] for name, measure in _MEASURES.items()}
    rows = [(name, *values) for name, values in figures.items() if any(v != "-" for v in values)]
    return table("Main figures", ["", *(run.name for run in runs)], rows)


def _posed(run: Run) -> str:
    return f"{run.summary['posed']} of {run.summary['frames']} ({run.summary['posed_share']:.1%})"


def _path_length(run: Run) -> str:
    return f"{number(run.path_length, 4)} {run.unit}" if run.posed_segments else "-"


def _ate(run: Run) -> str:
    if run.comparison is None:
        return "-"
    ate = run.comparison.measures["ate"]
    share = ate.get("percent_of_path")
    of_path = "" if share is None else f" ({number(share)}% of the path)"
    return f"{number(ate['rmse'])} m{of_path}"


def _expected_ate(run: Run) -> str:
    expected = run.summary["expected_ate"]
    if expected["rmse"] == 0:
        return "-"
    return f"{number(expected['percent_of_path'], 2)}% of the path at least"


def _relative_error(run: Run) -> str:
    if run.comparison is None:
        return "-"
    error = run.comparison.measures["rpe_frames"]
    if "rmse" not in error["translation"]:
        return "-"
    rotation = number(error["rotation_deg"]["rmse"])
    return f"{number(error['translation']['rmse'])} m, {rotation}°"


def _coverage(run: Run) -> str:
    return f"{run.comparison.measures['coverage']:.1%}" if run.comparison else "-"


def _median_time(run: Run) -> str:
    median_ms = run.timing.median_ms
    return "-" if median_ms is None else f"{median_ms:.1f} ms"


def _dropped(run: Run) -> str:
    dropped = run.timing.num_dropped
    return "-" if dropped is None else str(dropped)


_MEASURES: dict[str, Callable[[Run], str]] = {
    "Outcome": lambda run: str(run.summary["outcome"]),
    "Frames posed": _posed,
    "Segments": lambda run: str(len(run.posed_segments)),
    "Path length": _path_length,
    "ATE of the final trajectory": _ate,
    "Expected ATE": _expected_ate,
    "RPE from frame to frame": _relative_error,
    "Share of the truth covered": _coverage,
    "Time per frame, median": _median_time,
    "Images dropped in real time": _dropped,
    "Adjusted as a whole": lambda run: "yes" if "refinement" in run.summary else "-",
    "Keyframes": lambda run: str(run.summary["keyframes"]),
    "Landmarks": lambda run: str(run.summary["landmarks"]),
    "Input": lambda run: breakable(run.summary["input"]),
    "Camera from": lambda run: breakable(run.summary["camera_source"]),
    "corvo": lambda run: str(run.timing.environment["corvo"]),
}
