# SPDX-License-Identifier: MIT
"""Runs a sweep on a cluster of Ray's nodes on this machine, of which some are killed meanwhile.

    python sweep_cluster.py PLAN.yaml DIR --nodes 4 --kill 50 100
"""

import argparse
import logging
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sweep_support import start_sweep


def sweep_on_cluster(plan: Path, folder: Path, num_nodes: int, kills: list[int]) -> int:
    """Runs a sweep and returns its exit code.

    Args:
        plan: The plan.
        folder: The folder of the sweep.
        num_nodes: The number of nodes, each with one processor, beside the head, which has none.
        kills: The numbers of finished runs at which a node is killed, ascending.
    """
    from ray.cluster_utils import Cluster

    node: dict[str, Any] = {"object_store_memory": 80 << 20, "include_dashboard": False}
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, **node})
    try:
        nodes = [cluster.add_node(num_cpus=1, **node) for _ in range(num_nodes)]
        with start_sweep(plan, "-o", folder, "--address", cluster.address) as process:
            for count in kills:
                _wait_for_runs(folder / "journal.jsonl", count, process)
                cluster.remove_node(nodes.pop(), allow_graceful=False)
                print(f"a node was killed after {count} runs", file=sys.stderr, flush=True)
            output, messages = process.communicate()
        print(output + messages, file=sys.stderr)
        return process.returncode
    finally:
        stop: Callable[[], None] = cluster.shutdown
        stop()


def _wait_for_runs(journal: Path, count: int, process: subprocess.Popen[str]) -> None:
    while not journal.exists() or journal.read_bytes().count(b"\n") < count:
        if process.poll() is not None:
            raise RuntimeError(f"the sweep ended before {count} runs: {process.communicate()}")
        time.sleep(0.05)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("plan", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--nodes", type=int, default=4)
    parser.add_argument("--kill", type=int, nargs="*", default=[50, 100], metavar="RUNS")
    given = parser.parse_args()
    logging.basicConfig(level=logging.ERROR)
    return sweep_on_cluster(given.plan, given.folder, given.nodes, given.kill)


if __name__ == "__main__":
    sys.exit(main())
