# SPDX-License-Identifier: MIT
"""What the rows of a sweep come to, by queries of DuckDB."""

import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import duckdb

from corvo._corvo import Error
from corvo.sweep.bootstrap import Interval, median_interval
from corvo.sweep.metrics import METRICS, Metric

_KEYS = ("key", "input", "options", "perturbation", "judged", "failure", "detail", "corvo")


@dataclass(frozen=True)
class Spread:
    """The values of a metric over the judged runs of a sequence under one set of options."""

    median: float
    worst: float
    interval: Interval


@dataclass(frozen=True)
class Group:
    """A sequence under one set of options."""

    input: str
    options: str
    num_runs: int
    num_failed: int
    spreads: dict[str, Spread | None]
    """By metric; None where none of the runs could be compared with a ground truth."""


class Rows:
    """The rows of a sweep.

    Args:
        file: The Parquet file.

    Raises:
        Error: It cannot be read or has other columns.
    """

    def __init__(self, file: Path) -> None:
        self._database = duckdb.connect()
        self.load("runs", file)

    def load(self, table: str, file: Path) -> None:
        """Makes the rows of a file a table for queries. Raises Error as the constructor does."""
        columns = ", ".join([*_KEYS, *METRICS])
        try:
            self._database.execute(
                f"CREATE TABLE {table} AS SELECT {columns}, file_row_number AS position "
                "FROM read_parquet(?, file_row_number = true)",
                [str(file)],
            )
        except duckdb.Error as error:
            reason = str(error).splitlines()[0]
            raise Error(f"{file}: is no table of a sweep ({reason})") from None

    def query(self, sql: str, parameters: Sequence[Any] = ()) -> list[tuple[Any, ...]]:
        """Returns the rows of a query of the table `runs`."""
        found: list[tuple[Any, ...]] = self._database.execute(sql, list(parameters)).fetchall()
        return found

    def texts(self, column: str) -> list[str]:
        """Returns the different texts of a column in their order."""
        sql = f"SELECT {column} FROM runs GROUP BY {column} ORDER BY min(position)"
        return [text for (text,) in self.query(sql)]

    def costs(self, file: Path) -> list[tuple[Any, ...]]:
        """Returns a line for each sequence: its name, processor time, memory and time of a run.

        Args:
            file: The table of the same sweep's times.
        """
        return self.query(
            "SELECT input, median(processor_ms_per_frame), max(peak_memory_mb), median(wall_s) "
            "FROM runs JOIN read_parquet(?) USING (key) WHERE runs.failure IS NULL "
            "GROUP BY input ORDER BY min(position)",
            [str(file)],
        )

    def groups(self, metrics: Sequence[str]) -> list[Group]:
        """Returns what the judged runs of each sequence and set of options come to."""
        lists = "".join(f", list({name} ORDER BY position)" for name in metrics)
        found = self.query(
            f"SELECT input, options, count(*), count(failure){lists} FROM runs WHERE judged "
            "GROUP BY input, options ORDER BY min(position)"
        )
        return [
            Group(
                input, options, runs, failed,
                {name: _spread(METRICS[name], column) for name, column in zip(metrics, columns)},
            )
            for input, options, runs, failed, *columns in found
        ]  # fmt: skip


def _spread(metric: Metric, values: Sequence[float | None]) -> Spread | None:
    if all(value is None for value in values):
        return None
    known = [metric.worst if value is None else float(value) for value in values]
    worst = max(known) if metric.better == "less" else min(known)
    return Spread(statistics.median(known), worst, median_interval(known))
