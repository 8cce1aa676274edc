# SPDX-License-Identifier: MIT
"""What the frames of a run cost."""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from corvo.result import Result

STAGES = {
    "extract_ms": "features",
    "locate_ms": "locating the frame",
    "map_ms": "extending the map",
    "adjust_ms": "starting adjustments and waiting for them",
    "total_ms": "processing in all",
    "read_ms": "reading the image before",
}
PERCENTILES = (50, 90, 99, 100)


@dataclass(frozen=True)
class Timing:
    """timing.csv and environment.json."""

    columns: dict[str, NDArray[np.float64]]  # Shape (n,), ms, by the names of STAGES.
    latency_ms: NDArray[np.float64] | None  # In real time: from when an image was due.
    environment: dict[str, Any]

    @property
    def median_ms(self) -> float | None:
        total = self.columns["total_ms"]
        return float(np.median(total)) if len(total) else None

    @property
    def num_dropped(self) -> int | None:
        """Images that came too early in real time; None for a run that was not."""
        dropped = self.environment.get("realtime", {}).get("dropped")
        return None if dropped is None else int(dropped)


def read_timing(result: Result) -> Timing:
    rows = result.read_table("timing.csv")
    columns = {name: np.array([float(row[name]) for row in rows], np.float64) for name in STAGES}
    latencies = [row["latency_ms"] for row in rows]
    environment = json.loads(result.file("environment.json").read_text(encoding="utf-8"))
    return Timing(
        columns,
        np.array(latencies, np.float64) if rows and all(latencies) else None,
        environment,
    )


def percentiles(values: NDArray[np.float64]) -> list[float]:
    """Returns the percentiles PERCENTILES of at least one value."""
    return [float(value) for value in np.percentile(values, PERCENTILES)]
