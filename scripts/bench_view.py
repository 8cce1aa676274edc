#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures by how much the live view slows the odometry down.

    bench_view.py ROUNDS INPUT [OPTIONS OF corvo run]

Runs the odometry on the decoded images of an input without and with a view that is saved to a file,
in alternation, and prints the medians of wall and processor time, their ratios, and the number of
images that were not shown because the odometry was faster than the view.
"""

import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from corvo import view
from corvo._corvo import Inputs


class Cost(NamedTuple):
    """The time of a run in s, and the number of images that were not shown."""

    wall: float
    caller: float  # Processor time of the thread that calls the odometry.
    processor: float  # Processor time of all threads, until everything is saved.
    dropped: int


def measure(arguments: list[str], images: list, with_view: bool) -> Cost:
    odometry = Inputs(arguments).odometry()
    stream = view.make_stream()
    with tempfile.TemporaryDirectory() as folder:
        view.save_to(stream, Path(folder) / "view.rrd")
        recorder = view.Recorder(stream, view.Intrinsics.of(odometry.camera))
        with view.Sink(recorder) as sink:
            live = view.LiveView(odometry, sink)
            processor, caller, wall = time.process_time(), time.thread_time(), time.perf_counter()
            for timestamp_ns, image, mask in images:
                frame = odometry.process(image, timestamp_ns, mask)
                if with_view:
                    live.add(frame, image)
            wall, caller = time.perf_counter() - wall, time.thread_time() - caller
        processor = time.process_time() - processor
        stream.disconnect()
    return Cost(wall, caller, processor, sink.num_dropped)


def main() -> None:
    rounds, arguments = int(sys.argv[1]), sys.argv[2:]
    images = [image for image in Inputs(arguments) if image[1] is not None]
    costs: dict[bool, list[Cost]] = {False: [], True: []}
    for i in range(2 * rounds):
        costs[i % 2 == 1].append(measure(arguments, images, i % 2 == 1))
    for name in ("wall", "caller", "processor"):
        without, with_view = (
            1e3 / len(images) * statistics.median(getattr(cost, name) for cost in costs[key])
            for key in (False, True)
        )
        print(
            f"{name}: {without:.2f} ms a frame without the view, {with_view:.2f} with it, "
            f"ratio {with_view / without:.3f}"
        )
    dropped = statistics.median(cost.dropped for cost in costs[True])
    print(f"images: {len(images)}, not shown: {dropped:g}")


if __name__ == "__main__":
    main()
