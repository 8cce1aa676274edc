# SPDX-License-Identifier: MIT
"""A sweep on a cluster whose nodes are killed."""

import json
from pathlib import Path

from conftest import Sequence as Room
from sweep_cluster import sweep_on_cluster
from sweep_support import sweep


def test_rows_do_not_depend_on_nodes_that_are_killed(room: Room, tmp_path: Path) -> None:
    plan = tmp_path / "plan.yaml"
    entry = {"path": str(room.folder), "camera": str(room.folder / "camera.yaml"), "count": 60}
    plan.write_text(json.dumps({"inputs": [entry], "perturbations": [{"start": list(range(8))}]}))
    assert sweep_on_cluster(plan, tmp_path / "cluster", 3, [1, 3]) == 0
    assert sweep(plan, "-o", tmp_path / "undisturbed")[0] == 0
    rows = [(tmp_path / name / "rows.parquet").read_bytes() for name in ("cluster", "undisturbed")]
    assert rows[0] == rows[1]
