# SPDX-License-Identifier: MIT
"""The outcomes of a sweep as Parquet files."""

from collections.abc import Iterable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from corvo.files import write_whole
from corvo.sweep.child import Outcome
from corvo.sweep.tasks import Task

_INTEGERS = ("frames", "segments", "losses")
_TEXTS = ("reason",)
_NUMBERS = ("posed_share", "rotation_share", "coverage", "ate", "ate_percent", "live_ate", "rpe",
            "rpe_deg", "rotation_deg", "t_rel_percent", "r_rel_deg_per_100m", "scale_drift",
            "scale_percent_per_km")  # fmt: skip

ROW_SCHEMA = pa.schema(
    [(name, pa.string()) for name in ("key", "input", "options", "perturbation")]
    + [("judged", pa.bool_()), ("failure", pa.string()), ("detail", pa.string())]
    + [(name, pa.int64()) for name in _INTEGERS]
    + [(name, pa.float64()) for name in _NUMBERS]
    + [(name, pa.string()) for name in _TEXTS]
    + [("content", pa.string()), ("corvo", pa.string())]
)

_RUN_SCHEMA = pa.schema(
    [("key", pa.string()), ("attempts", pa.int64()), ("node", pa.string())]
    + [(name, pa.float64()) for name in ("wall_s", "odometry_s", "processor_s",
                                         "processor_ms_per_frame", "peak_memory_mb")]
    + [("last_lines", pa.string())]
)  # fmt: skip


def write_rows(
    file: Path, tasks: Iterable[Task], outcomes: Mapping[str, Outcome], build: str
) -> None:
    """Writes what finished runs measured, in the order of the plan."""
    rows = [_row(task, outcomes[task.key], build) for task in tasks if task.key in outcomes]
    _write(file, rows, ROW_SCHEMA)


def write_runs(file: Path, tasks: Iterable[Task], outcomes: Mapping[str, Outcome]) -> None:
    """Writes the times and circumstances of finished runs, each once."""
    keys = dict.fromkeys(task.key for task in tasks if task.key in outcomes)
    _write(file, [_run(key, outcomes[key]) for key in keys], _RUN_SCHEMA)


def _row(task: Task, outcome: Outcome, build: str) -> dict[str, Any]:
    return {
        **outcome.row,
        "key": task.key,
        "input": task.input.name,
        "options": task.options.label,
        "perturbation": task.perturbation.title,
        "judged": task.is_judged,
        "failure": outcome.failure,
        "detail": outcome.detail or None,
        "content": task.content,
        "corvo": build,
    }


def _run(key: str, outcome: Outcome) -> dict[str, Any]:
    return {
        **outcome.times,
        "key": key,
        "attempts": outcome.attempts,
        "node": outcome.node,
        "last_lines": outcome.last_lines,
    }


def _write(file: Path, rows: list[dict[str, Any]], schema: pa.Schema) -> None:
    buffer = BytesIO()
    pq.write_table(pa.Table.from_pylist(rows, schema), buffer, compression="zstd")
    write_whole(file, buffer.getvalue())
